#include "raster/rasterizer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hemicube::raster {
namespace {

/// Single precision turns and projects a box with errors below 2^-21 of its distance; what is
/// further from the eye than the scene is large cannot be reached.
constexpr double kBoxSlack = 0x1p-19;

/// The power of 2 that brings x > 0 into [1, 2), as far as it is a float: the depths of scenes so
/// small that it would not be are none either.
double unit_of(double x) {
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(x) & std::uint64_t{0x7ff} << 52;
  return std::min(std::bit_cast<double>((std::uint64_t{2046} << 52) - exponent), 0x1p126);
}

void copy(const Vec3& from, double to[3]) {
  for (int k = 0; k < 3; ++k)
    to[k] = from[k];
}

void copy(const Vec3& from, float to[3]) {
  for (int k = 0; k < 3; ++k)
    to[k] = static_cast<float>(from[k]);
}

} // namespace

Status Rasterizer::init(const PolygonTree& tree, const Kernels& kernels, Culling culling) {
  tree_ = &tree;
  kernels_ = &kernels;
  culling_ = culling;
  const auto corners = static_cast<std::size_t>(tree.most_corners());
  HC_TRY(edges_.resize(corners * 3 * kBatch));
  HC_TRY(moved_corners_.resize(corners * 3 * kBatch * 3 / 2));
  batch_.edges = edges_.data();
  return queue_.init();
}

void Rasterizer::begin(const View& view) {
  view_ = view;
  farthest_ = tree_->radius() + glm::length(view.eye - tree_->origin());
  WindowProblem& p = polygon_problem_;
  copy(view.eye, p.eye);
  p.above_horizon = view.above_horizon ? 1 : 0;
  p.draw_backs = view.draw_backs ? 1 : 0;
  if (view.skip < tree_->polygon_count())
    // Also its other side, and copies of it: where it is slightly bent their planes pass the eye.
    tree_->plane(view.skip, p.skip_normal, p.skip_point);
  else
    copy(Vec3(std::numeric_limits<double>::quiet_NaN()), p.skip_normal);
}

void Rasterizer::set_window(Face face, const PixelGrid& grid, const Window& window) {
  WindowProblem& p = polygon_problem_;
  // The axes of the face: from_face of its right, up and forward.
  const Vec3 axes[3] = {from_face(face, {1, 0, 0}), from_face(face, {0, 1, 0}),
                        from_face(face, {0, 0, 1})};
  Vec3 frame[3];
  for (int k = 0; k < 3; ++k) {
    frame[k] = view_.axis_x * axes[k].x + view_.axis_y * axes[k].y + view_.axis_z * axes[k].z;
    copy(frame[k], p.frame[k]);
  }
  p.horizon_axis = face == Face::kTop ? 2 : 1;
  p.x0 = grid.x0;
  p.dx = grid.dx;
  p.y0 = grid.y0;
  p.dy = grid.dy;
  p.columns_per_x = 1 / grid.dx;
  p.rows_per_y = 1 / grid.dy;
  p.x_begin = window.x;
  p.x_end = window.x + window.width;
  p.y_begin = window.y;
  p.y_end = window.y + window.height;
  p.x_reach = std::fabs(grid.x0) + grid.width * std::fabs(grid.dx);
  p.y_reach = std::fabs(grid.y0) + grid.height * std::fabs(grid.dy);

  NodeProblem& n = node_problem_;
  const Vec3 eye = view_.eye - tree_->origin();
  const double reach = 1.001 * farthest_; // beyond rounding
  p.edge_on_to_eye = kThroughEye * kThroughEye * reach * reach;
  p.edge_on_to_receiver = kEdgeOn * reach;
  p.unit = unit_of(farthest_);
  copy(eye, n.eye);
  n.slack = static_cast<float>(kBoxSlack * farthest_);
  for (int k = 0; k < 3; ++k)
    copy(frame[k], n.frame[k]);
  const auto side = [&](int k, const Vec3& across, double at, double inwards) {
    copy((across - frame[2] * at) * inwards, n.inward[k]);
  };
  side(0, frame[0], grid.x0 + (p.x_begin - 1) * grid.dx, grid.dx > 0 ? 1 : -1);
  side(1, frame[0], grid.x0 + p.x_end * grid.dx, grid.dx > 0 ? -1 : 1);
  side(2, frame[1], grid.y0 + (p.y_begin - 1) * grid.dy, grid.dy > 0 ? 1 : -1);
  side(3, frame[1], grid.y0 + p.y_end * grid.dy, grid.dy > 0 ? -1 : 1);
  copy(view_.axis_z, n.inward[4]);
  n.plane_count = view_.above_horizon ? 5 : 4;
  n.x_scale = static_cast<float>(p.columns_per_x);
  n.x_offset = static_cast<float>(-grid.x0 * p.columns_per_x - p.x_begin);
  n.y_scale = static_cast<float>(p.rows_per_y);
  n.y_offset = static_cast<float>(-grid.y0 * p.rows_per_y - p.y_begin);
  n.columns = static_cast<float>(window.width);
  n.rows = static_cast<float>(window.height);
  n.find_away = view_.draw_backs ? 0 : 1;
}

void Rasterizer::draw(Face face, const PixelGrid& grid, ItemBuffer* buffer) {
  if (tree_->nodes().empty())
    return;
  set_window(face, grid, buffer->window());
  if (culling_ == Culling::kOn) {
    draw_front_to_back(buffer->planes());
    return;
  }
  for (std::uint32_t c = 0; c < tree_->cluster_count(); ++c)
    draw_cluster(c, Occlusion::kOpen, buffer->planes());
}

/// Calls take(visit) for the children that the window may see.
template <typename Take> void Rasterizer::open_node(const Node& node, Take take) {
  NodeResult result;
  kernels_->test_node(&node, &node_problem_, &result);
  for (std::uint32_t left = result.reached & ~result.away; left != 0; left &= left - 1) {
    const int c = std::countr_zero(left);
    if (result.x_begin[c] >= result.x_end[c] || result.y_begin[c] >= result.y_end[c])
      continue;
    const Range pixels = {result.x_begin[c], result.y_begin[c], result.x_end[c] - 1,
                          result.y_end[c] - 1};
    take(Visit{node.child[c], (node.clusters >> c & 1) != 0, pixels, result.nearest[c]});
  }
}

void Rasterizer::draw_front_to_back(const WindowPlanes& planes) {
  queue_.begin(static_cast<float>(1 / farthest_));
  const auto push = [&](const Visit& visit) { queue_.push(visit); };
  open_node(tree_->nodes()[0], push);
  while (!queue_.empty()) {
    const Visit visit = queue_.pop();
    if (!queue_.empty())
      tree_->prefetch(queue_.front().index, queue_.front().is_cluster);
    if (visit.is_cluster || queue_.room() < kBatch)
      draw_visit(visit, planes);
    else if (kernels_->occlusion(&planes, &visit.pixels, visit.nearest) != Occlusion::kHidden)
      open_node(tree_->nodes()[visit.index], push);
  }
}

/// Draws a cluster, or all of a node.
void Rasterizer::draw_visit(const Visit& visit, const WindowPlanes& planes) {
  const Occlusion occlusion = kernels_->occlusion(&planes, &visit.pixels, visit.nearest);
  if (occlusion == Occlusion::kHidden)
    return;
  if (!visit.is_cluster) {
    open_node(tree_->nodes()[visit.index], [&](const Visit& child) { draw_visit(child, planes); });
    return;
  }
  draw_cluster(visit.index, occlusion, planes);
  const Range tiles = tiles_of(visit.pixels);
  const auto columns =
      static_cast<std::uint32_t>((std::uint64_t{2} << tiles.x1) - (std::uint64_t{1} << tiles.x0));
  for (std::int32_t y = tiles.y0; y <= tiles.y1; ++y)
    planes.dirty[y] |= columns;
}

void Rasterizer::draw_cluster(std::uint32_t index, Occlusion occlusion,
                              const WindowPlanes& planes) {
  const Cluster cluster = tree_->cluster(index);
  std::uint32_t drawn =
      kernels_->find_bounds(&cluster, &polygon_problem_, moved_corners_.data(), &batch_);
  if (occlusion == Occlusion::kCovered)
    drawn &= ~kernels_->hidden(&batch_, drawn, &planes);
  kernels_->set_up(&cluster, &polygon_problem_, moved_corners_.data(), drawn, &batch_);
  kernels_->draw(&batch_, drawn, &planes);
}

} // namespace hemicube::raster
