#pragma once

#include "radiosity/mesh/patch_set.h"
#include "raster/face_view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hemicube::bench {

/// Rows of form factors, each over all patches of the scene: dense, [row][patch].
using DenseRows = std::vector<double>;

/// A program that computes rows of form factors from hemicubes, on one thread. All see the same
/// patches from the same eyes through the same pixel centres, and weigh pixels alike.
class Peer {
public:
  virtual ~Peer() = default;

  virtual std::string name() const = 0;

  /// Builds what all rows share: not timed. The patches outlive the peer.
  virtual void prepare(const radiosity::PatchSet& patches, std::uint32_t resolution) = 0;

  /// Computes the rows of the receivers; what is timed is this call, unless seconds() says more.
  /// @param dense  null, or filled with the rows
  /// @param hash   of the rows
  virtual void rows(std::span<const std::uint32_t> receivers, DenseRows* dense,
                    std::uint64_t* hash) = 0;

  /// What the last call of rows() took, for a peer whose call includes work that belongs into
  /// prepare(); negative: the whole call counts.
  virtual double seconds() const { return -1; }
};

/// Null where Embree was not found when the program was built.
std::unique_ptr<Peer> make_embree_peer(bool robust);

/// Null where EGL and OpenGL were not found, or no software driver answers.
std::unique_ptr<Peer> make_llvmpipe_peer();

/// Clears, writes and reads the same pixels once: what no program that draws pixels can beat.
std::unique_ptr<Peer> make_floor_peer();

} // namespace hemicube::bench
