#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/refine/element_tree.h"

#include <memory>

namespace hemicube::radiosity {

/// The rows of elements as they were gathered: over whole patches, each row once, when its element
/// came to be.
class ElementRows {
public:
  /// Makes room for rows. @return where they are to be appended; valid until the next call
  Status begin_round(std::uint64_t row_count, std::uint32_t patch_count, FormFactorMatrix** rows);

  /// Row `index` of the round that was begun last is that of an element.
  /// @param side  0 for the front of the node, 1 for its back
  void assign(std::uint32_t node, unsigned side, std::uint64_t index);

  /// Makes the form factors between the elements there are now: what a row says of a patch is
  /// divided among its elements in the ratio of what the receiver would exchange with them if
  /// nothing were in between. Elements thus send out light as finely as they receive it, and no row
  /// is gathered again because another patch was cut.
  /// @param elements  tree.make_mesh()
  /// Deterministic: + - * / sqrt only.
  Status make_matrix(const ElementTree& tree, const PatchSet& elements, Executor& executor,
                     FormFactorMatrix* matrix);

private:
  class Divider;
  /// How a row was divided last.
  struct Shares {
    Buffer<std::uint32_t> counts; ///< [patch of the row] elements
    Buffer<float> values;         ///< of each patch with more than one, one after the other
  };
  struct Round {
    FormFactorMatrix rows;
    std::vector<Shares> shares; ///< [row]
  };
  struct Place {
    std::uint32_t round = 0;
    std::uint64_t index = 0;
  };

  std::vector<std::unique_ptr<Round>> rounds_;
  std::vector<Place> places_[2]; ///< [side][node]
};

} // namespace hemicube::radiosity
