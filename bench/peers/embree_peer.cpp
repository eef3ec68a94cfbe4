// Intel Embree 3: rays through the pixel centres, in its fastest mode: packets of 16 rays for 4 x 4
// pixels, marked as coherent.
#include "bench/peers/peer.h"
#include "bench/peers/run_reader.h"
#include "radiosity/hemicube/five_views.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hemicube::bench {
namespace {

using raster::Face;
using raster::Item;

constexpr std::int32_t kSide = 4; ///< pixels of a packet along each axis
constexpr int kLanes = kSide * kSide;

/// Denormals off, as Embree asks for, for the life of the object.
class FlushedDenormals {
public:
  FlushedDenormals() : control_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushedDenormals() { _mm_setcsr(control_); }
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;

private:
  unsigned control_;
};

/// Directions of a face in the world: those of packet (x, y) are its corner's plus `lane`.
struct FaceRays {
  Vec3 corner, right, up; ///< of pixel (0, 0); from a pixel to the next
  alignas(64) float lane[3][kLanes];

  FaceRays(const raster::View& view, Face face, const raster::PixelGrid& grid) {
    const auto world = [&](const Vec3& v) {
      const Vec3 in_view = raster::from_face(face, v);
      return view.axis_x * in_view.x + view.axis_y * in_view.y + view.axis_z * in_view.z;
    };
    corner = world({grid.x0, grid.y0, 1});
    right = world({grid.dx, 0, 0});
    up = world({0, grid.dy, 0});
    for (int k = 0; k < kLanes; ++k)
      for (int axis = 0; axis < 3; ++axis)
        lane[axis][k] =
            static_cast<float>(right[axis] * (k % kSide) + up[axis] * static_cast<int>(k / kSide));
  }
};

class EmbreePeer : public Peer {
public:
  explicit EmbreePeer(bool robust) : robust_(robust) {
    device_ = rtcNewDevice("threads=1");
    if (device_ == nullptr)
      throw std::runtime_error("Embree makes no device");
  }
  ~EmbreePeer() override {
    release_scene();
    rtcReleaseDevice(device_);
  }
  EmbreePeer(const EmbreePeer&) = delete;
  EmbreePeer& operator=(const EmbreePeer&) = delete;

  std::string name() const override { return robust_ ? "embree robust" : "embree"; }
  void prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) override;
  void rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
            std::uint64_t* hash) override;

private:
  void release_scene() {
    if (scene_ != nullptr)
      rtcReleaseScene(scene_);
    scene_ = nullptr;
  }
  void build_scene();
  void aim_from(const Vec3& eye);
  void trace_face(const FaceRays& rays, const raster::PixelGrid& grid);
  void store_items(Item* corner) const;

  bool robust_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  const radiosity::PatchSet* patches_ = nullptr;
  std::vector<Item> patch_of_; ///< [triangle]
  float nearest_ = 0;
  RunReader reader_;
  std::vector<Item> plane_; ///< of one face, row-major, room of 16 before and after
  std::size_t pitch_ = 0;
  alignas(64) RTCRayHit16 packet_{};
  RTCIntersectContext context_{};
};

void EmbreePeer::prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) {
  if (resolution % (2 * kSide) != 0)
    throw std::runtime_error("the resolution must be a multiple of 8");
  patches_ = &patches;
  reader_.prepare(patches.patch_count(), resolution);
  pitch_ = resolution;
  plane_.assign(pitch_ * pitch_ + 32, raster::kNoItem);
  release_scene();
  build_scene();
}

void EmbreePeer::build_scene() {
  scene_ = rtcNewScene(device_);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(scene_, robust_ ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               patches_->vertices.size()));
  Vec3 low = patches_->vertices[0], high = low;
  for (std::size_t k = 0; k < patches_->vertices.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double at = patches_->vertices[k][axis];
      vertices[3 * k + static_cast<std::size_t>(axis)] = static_cast<float>(at);
      low[axis] = std::min(low[axis], at);
      high[axis] = std::max(high[axis], at);
    }
  // The eye lies on the receiver, which must not be hit: 1e-5 of the scene's diagonal is skipped.
  nearest_ = static_cast<float>(1e-5 * glm::length(high - low));
  std::vector<unsigned> corners;
  patch_of_.clear();
  for (std::uint32_t patch = 0; patch < patches_->patch_count(); ++patch) {
    const auto polygon = patches_->corners_of(patch);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      corners.insert(corners.end(), {polygon[0], polygon[k - 1], polygon[k]});
      patch_of_.push_back(patch);
    }
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), patch_of_.size()));
  std::copy(corners.begin(), corners.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree builds no scene");
}

void EmbreePeer::aim_from(const Vec3& eye) {
  RTCRay16& ray = packet_.ray;
  for (int k = 0; k < kLanes; ++k) {
    ray.org_x[k] = static_cast<float>(eye.x);
    ray.org_y[k] = static_cast<float>(eye.y);
    ray.org_z[k] = static_cast<float>(eye.z);
    ray.tnear[k] = nearest_;
    ray.time[k] = 0;
    ray.mask[k] = 0xffffffffu;
    ray.id[k] = 0;
    ray.flags[k] = 0;
    packet_.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
}

void EmbreePeer::trace_face(const FaceRays& rays, const raster::PixelGrid& grid) {
  alignas(64) static const int kAll[kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                               -1, -1, -1, -1, -1, -1, -1, -1};
  RTCRay16& ray = packet_.ray;
  for (std::int32_t y = 0; y < grid.height; y += kSide)
    for (std::int32_t x = 0; x < grid.width; x += kSide) {
      const Vec3 corner =
          rays.corner + rays.right * static_cast<double>(x) + rays.up * static_cast<double>(y);
      const float corner_x = static_cast<float>(corner.x);
      const float corner_y = static_cast<float>(corner.y);
      const float corner_z = static_cast<float>(corner.z);
      for (int k = 0; k < kLanes; ++k) {
        ray.dir_x[k] = corner_x + rays.lane[0][k];
        ray.dir_y[k] = corner_y + rays.lane[1][k];
        ray.dir_z[k] = corner_z + rays.lane[2][k];
        ray.tfar[k] = std::numeric_limits<float>::infinity();
        packet_.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(kAll, scene_, &context_, &packet_);
      store_items(plane_.data() + 16 + static_cast<std::size_t>(y) * pitch_ +
                  static_cast<std::size_t>(x));
    }
}

void EmbreePeer::store_items(Item* corner) const {
  const RTCHit16& hit = packet_.hit;
  const RTCRay16& ray = packet_.ray;
  alignas(64) Item items[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const bool is_hit = hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    const float away =
        hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
    const Item item = patch_of_[is_hit ? hit.primID[k] : 0] | (away > 0 ? raster::kBackFacing : 0);
    items[k] = is_hit ? item : raster::kNoItem;
  }
  for (std::size_t row = 0; row < kSide; ++row)
    std::copy_n(items + row * kSide, kSide, corner + row * pitch_);
}

void EmbreePeer::rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
                      std::uint64_t* hash) {
  const FlushedDenormals flushed;
  rtcInitIntersectContext(&context_);
  context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (dense != nullptr)
    dense->assign(receivers.size() * patches_->patch_count(), 0);
  Hash all;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    const raster::View view = radiosity::hemicube_view(*patches_, receivers[k]);
    aim_from(view.eye);
    for (int f = 0; f < raster::kFaceCount; ++f) {
      const Face face = static_cast<Face>(f);
      const raster::PixelGrid grid = raster::hemicube_grid(face, reader_.resolution());
      trace_face(FaceRays(view, face, grid), grid);
      for (std::int32_t y = 0; y < grid.height; ++y)
        reader_.add_row(face, y, plane_.data() + 16 + static_cast<std::size_t>(y) * pitch_);
    }
    reader_.finish(dense == nullptr ? nullptr : dense->data() + k * patches_->patch_count(), &all);
  }
  *hash = all.value();
}

} // namespace

std::unique_ptr<Peer> make_embree_peer(bool robust) {
  return std::make_unique<EmbreePeer>(robust);
}

} // namespace hemicube::bench
