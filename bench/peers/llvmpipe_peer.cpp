#include "bench/peers/chunk_queue.h"
#include "bench/peers/chunked_mesh.h"
#include "bench/peers/egl_context.h"
#include "bench/peers/peer.h"
#include "bench/peers/run_reader.h"

#include "radiosity/hemicube/five_views.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <malloc.h>
#include <utility>

namespace hemicube::bench {
namespace {

constexpr std::size_t kSlack = 16; ///< items before and after a plane

/// Patches per chunk; the fastest for a scene and a resolution is used. 0: all in one.
constexpr std::uint32_t kChunkSizes[] = {0, 64, 256};

const char* const kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in uint id;
layout(location = 0) uniform mat4 matrix;
flat out uint patch_id;
void main() {
  gl_Position = matrix * vec4(position, 1.0);
  patch_id = id;
}
)";

const char* const kFragmentShader = R"(#version 450 core
flat in uint patch_id;
layout(location = 0) out uint item;
void main() {
  item = gl_FrontFacing ? patch_id : patch_id | 0x80000000u;
}
)";

/// Mesa's software rasterizer on one thread: ids and depths of one face at a time, read back.
/// The receiver is left out by its index range; a patch on its back side, with the same vertices,
/// is not: scenes are one-sided. Among overlapping coplanar patches, rounding and the order of
/// drawing decide: where a scene has them, the hash depends on the size of the chunks.
class LlvmpipePeer final : public Peer {
public:
  explicit LlvmpipePeer(std::unique_ptr<EglContext> context)
      : context_(std::move(context)), gl_(context_->gl) {}

  bool init();

  std::string name() const override { return "llvmpipe"; }
  void prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) override;
  void rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
            std::uint64_t* hash) override;

private:
  void make_frame_buffer();
  void upload();
  double seconds_for(std::span<const std::uint32_t> receivers);
  void draw_face(const FaceFrame& frame, std::uint32_t receiver);
  void add_range(std::uint32_t first, std::uint32_t end);

  std::unique_ptr<EglContext> context_;
  const GlFunctions& gl_;
  GLuint program_ = 0, frame_buffer_ = 0, ids_ = 0, depths_ = 0;
  GLuint vertex_array_ = 0, vertices_ = 0, indices_ = 0;

  const radiosity::PatchSet* patches_ = nullptr;
  std::uint32_t resolution_ = 0;
  ChunkedMesh mesh_;
  ChunkQueue queue_;
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
  std::vector<raster::Item> plane_; ///< kSlack items, then a face
  RunReader reader_;
};

bool LlvmpipePeer::init() {
  program_ = gl_.CreateProgram();
  const std::pair<GLenum, const char*> shaders[] = {{GL_VERTEX_SHADER, kVertexShader},
                                                    {GL_FRAGMENT_SHADER, kFragmentShader}};
  for (const auto& [kind, source] : shaders) {
    const GLuint shader = gl_.CreateShader(kind);
    gl_.ShaderSource(shader, 1, &source, nullptr);
    gl_.CompileShader(shader);
    gl_.AttachShader(program_, shader);
  }
  gl_.LinkProgram(program_);
  GLint linked = GL_FALSE;
  gl_.GetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
    return false;
  gl_.UseProgram(program_);
  gl_.GenFramebuffers(1, &frame_buffer_);
  gl_.GenRenderbuffers(1, &ids_);
  gl_.GenRenderbuffers(1, &depths_);
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &vertices_);
  gl_.GenBuffers(1, &indices_);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.FrontFace(GL_CW); // forward = right x up: the mirror image of what OpenGL takes for granted
  gl_.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  return true;
}

void LlvmpipePeer::make_frame_buffer() {
  const GLsizei size = static_cast<GLsizei>(resolution_);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, ids_);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, size, size);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, depths_);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size, size);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths_);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    std::fprintf(stderr, "llvmpipe: the frame buffer is incomplete\n");
}

void LlvmpipePeer::upload() {
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.vertices.size() * sizeof(GlVertex)),
                 mesh_.vertices.data(), GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh_.indices.size() * sizeof(std::uint32_t)),
                 mesh_.indices.data(), GL_STATIC_DRAW);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(GlVertex), nullptr);
  gl_.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(GlVertex),
                           reinterpret_cast<const void*>(offsetof(GlVertex, id)));
  gl_.EnableVertexAttribArray(0);
  gl_.EnableVertexAttribArray(1);
}

double LlvmpipePeer::seconds_for(std::span<const std::uint32_t> receivers) {
  rows(receivers.first(1), nullptr, nullptr); // shaders are compiled for a state when first drawn
  double best = std::numeric_limits<double>::max();
  for (int repetition = 0; repetition < 2; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    rows(receivers, nullptr, nullptr);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

void LlvmpipePeer::prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) {
  patches_ = &patches;
  resolution_ = resolution;
  plane_.assign(std::size_t{resolution} * resolution + 2 * kSlack, raster::kNoItem);
  reader_.prepare(patches.patch_count(), resolution);
  make_frame_buffer();
  std::vector<std::uint32_t> trial;
  for (std::uint64_t k = 0; k < 6; ++k)
    trial.push_back(static_cast<std::uint32_t>((2 * k + 1) * patches.patch_count() / 12));
  ChunkedMesh fastest;
  double least = std::numeric_limits<double>::max();
  for (const std::uint32_t size : kChunkSizes) {
    if (size >= patches.patch_count())
      continue;
    mesh_ = build_chunks(patches, size == 0 ? patches.patch_count() : size);
    upload();
    const double seconds = seconds_for(trial);
    if (seconds < least) {
      least = seconds;
      fastest = std::move(mesh_);
    }
  }
  mesh_ = std::move(fastest);
  upload();
  rows(trial, nullptr, nullptr);
}

void LlvmpipePeer::add_range(std::uint32_t first, std::uint32_t end) {
  if (first == end)
    return;
  counts_.push_back(static_cast<GLsizei>(end - first));
  offsets_.push_back(reinterpret_cast<const void*>(std::size_t{first} * sizeof(std::uint32_t)));
}

void LlvmpipePeer::draw_face(const FaceFrame& frame, std::uint32_t receiver) {
  const std::uint32_t skip_first = mesh_.first_index[receiver];
  const std::uint32_t skip_end =
      skip_first + 3 * (static_cast<std::uint32_t>(patches_->corners_of(receiver).size()) - 2);
  counts_.clear();
  offsets_.clear();
  for (const ChunkQueue::Entry& entry : queue_.sort(mesh_, frame)) {
    const Chunk& chunk = mesh_.chunks[entry.chunk];
    if (entry.chunk == mesh_.chunk_of[receiver]) {
      add_range(chunk.first_index, skip_first);
      add_range(skip_end, chunk.end_index);
    } else {
      add_range(chunk.first_index, chunk.end_index);
    }
  }
  const std::array<float, 16> matrix = clip_matrix(frame, 1e-5 * mesh_.size);
  const GLsizei width = static_cast<GLsizei>(resolution_);
  const GLsizei height = frame.side ? width / 2 : width;
  const GLuint nothing[] = {raster::kNoItem, 0, 0, 0};
  const GLfloat infinity[] = {0};
  gl_.Viewport(0, 0, width, height);
  gl_.UniformMatrix4fv(0, 1, GL_FALSE, matrix.data());
  gl_.ClearBufferuiv(GL_COLOR, 0, nothing);
  gl_.ClearBufferfv(GL_DEPTH, 0, infinity);
  gl_.MultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(counts_.size()));
  gl_.ReadPixels(0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, plane_.data() + kSlack);
}

void LlvmpipePeer::rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
                        std::uint64_t* hash) {
  const std::size_t columns = patches_->patch_count();
  if (dense != nullptr)
    dense->assign(receivers.size() * columns, 0);
  Hash sum;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    const raster::View view = radiosity::hemicube_view(*patches_, receivers[k]);
    for (int f = 0; f < raster::kFaceCount; ++f) {
      const auto face = static_cast<raster::Face>(f);
      draw_face(face_frame(view, face, mesh_.centre), receivers[k]);
      const std::int32_t height = raster::hemicube_grid(face, resolution_).height;
      for (std::int32_t y = 0; y < height; ++y)
        reader_.add_row(face, y,
                        plane_.data() + kSlack + static_cast<std::size_t>(y) * resolution_);
    }
    reader_.finish(dense == nullptr ? nullptr : dense->data() + k * columns, &sum);
  }
  if (hash != nullptr)
    *hash = sum.value();
}

} // namespace

std::unique_ptr<Peer> make_llvmpipe_peer() {
  // The driver allocates and frees its scenes again and again: keep the pages.
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 32 << 20); // the most that glibc takes
  std::string why;
  std::unique_ptr<EglContext> context = EglContext::open(&why);
  if (context != nullptr) {
    auto peer = std::make_unique<LlvmpipePeer>(std::move(context));
    if (peer->init())
      return peer;
    why = "the shaders do not link";
  }
  std::fprintf(stderr, "no llvmpipe: %s\n", why.c_str());
  return nullptr;
}

} // namespace hemicube::bench
