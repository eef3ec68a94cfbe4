#include "radiosity/discontinuity/split_edges.h"

#include <algorithm>
#include <bit>

namespace hemicube::radiosity {

std::size_t SplitEdges::PositionHash::operator()(const Vec3& position) const noexcept {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) // of 0 and -0 the same
    hash = (hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15u +
           std::bit_cast<std::uint64_t>(position[axis] + 0.0);
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

std::uint64_t SplitEdges::key(std::uint32_t a, std::uint32_t b) const noexcept {
  const std::uint64_t low = std::min(places_[a], places_[b]);
  const std::uint64_t high = std::max(places_[a], places_[b]);
  return low << 32 | high;
}

std::uint32_t SplitEdges::add_vertex(const Vec3& position) {
  const std::uint32_t number = vertex_count();
  positions_.push_back(position);
  places_.push_back(vertex_at_.try_emplace(position, number).first->second);
  return number;
}

std::uint32_t SplitEdges::split(std::uint32_t a, std::uint32_t b) const {
  const auto found = splits_.find(key(a, b));
  return found != splits_.end() ? found->second : kNone;
}

void SplitEdges::set_split(std::uint32_t a, std::uint32_t b, std::uint32_t vertex) {
  splits_.try_emplace(key(a, b), vertex);
}

void SplitEdges::append_hanging(std::uint32_t a, std::uint32_t b,
                                std::vector<std::uint32_t>* corners) const {
  const std::uint32_t between = split(a, b);
  if (between == kNone)
    return;
  append_hanging(a, between, corners);
  corners->push_back(between);
  append_hanging(between, b, corners);
}

EdgeLight SplitEdges::light_across(std::uint32_t a, std::uint32_t b) const {
  const auto found = lights_.find(key(a, b));
  return found != lights_.end() ? found->second : EdgeLight::kSmooth;
}

void SplitEdges::note_light(std::uint32_t a, std::uint32_t b, EdgeLight light) {
  if (light == EdgeLight::kSmooth)
    return;
  EdgeLight& known = lights_.try_emplace(key(a, b), light).first->second;
  known = std::max(known, light);
}

Status SplitEdges::append_lights(std::span<const std::uint32_t> polygon,
                                 Buffer<EdgeLight>* lights) const {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    HC_TRY(
        lights->push_back(light_across(polygon[k], polygon[k + 1 == polygon.size() ? 0 : k + 1])));
  return {};
}

} // namespace hemicube::radiosity
