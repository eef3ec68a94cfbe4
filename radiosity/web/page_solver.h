#pragma once

#include "radiosity/light_model.h"
#include "radiosity/row_run.h"
#include "radiosity/row_statistics.h"
#include "radiosity/solve/shooting.h"
#include "radiosity/web/page_scene.h"

#include <optional>

namespace hemicube::radiosity::web {

/// The light of the page, one shot at a time: what `hemicube solve --solver progressive --rung
/// hemicube` computes, the same bits, but rows are kept, so that other materials and lamps need no
/// new ones.
class PageSolver final : ShotRows {
public:
  /// @return as unpack_page_scene(); kInvalidArgument for a scene that space sends light into,
  ///         which the page does not show
  Status open(std::span<const std::byte> scene);

  const PageScene& page() const noexcept { return page_; }
  std::uint32_t patch_count() const noexcept { return page_.patches.patch_count(); }

  /// Forgets all rows; set_light() comes next.
  /// @param resolution  even, 16..2048
  Status set_resolution(std::uint32_t resolution);

  /// Begins anew: with what the scene says, times a share, before the first shot. Rows stay.
  /// @return kInvalidArgument unless all reflectances are below 1 then
  Status set_light(double reflectance, double exitance);

  bool is_converged() const noexcept;

  /// The next shot, by a row that is made now or was before; nothing once it is converged.
  Status shoot();

  /// Makes one of the rows that no shot has needed; nothing once all are there.
  Status fill();

  std::uint32_t row_count() const noexcept { return rows_made_; } ///< rows that are there
  /// Of all rows: what the program prints. 0 while rows are missing.
  std::uint64_t form_factor_hash() const;

  std::uint64_t shots() const noexcept { return shooting_.shots(); }
  double unshot() const noexcept { return shooting_.unshot(); }

  /// What the light is now, as a picture shows it: unshot light counts as it arrived, and what it
  /// will still make is guessed once it is converged, as in the program's pictures.
  Status displayed(Solution* solution);

private:
  Status prepare(std::span<const std::uint32_t> patches) override;
  Status row(std::size_t k, RowView* row) override;
  bool is_made(std::uint32_t patch) const noexcept;
  Status make(std::uint32_t patch);

  PageScene page_;
  Buffer<double> reflectance_, exitance_; ///< of the scene as it was read
  RowGeometry geometry_;
  SerialExecutor executor_;
  Options options_;
  std::optional<RowRun> run_; ///< of the resolution
  FormFactorMatrix kept_;     ///< row kBlockRows i belongs to patch i: they come in any order
  RowStatistics statistics_;
  std::uint32_t rows_made_ = 0, next_to_fill_ = 0;

  LightModel model_;
  LightProblem problem_;
  Shooting shooting_;
  std::span<const std::uint32_t> turn_; ///< the patches that shoot next
};

} // namespace hemicube::radiosity::web
