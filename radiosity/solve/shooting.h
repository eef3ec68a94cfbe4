#pragma once

#include "radiosity/solve/row_shooter.h"

namespace hemicube::radiosity {

/// Where shooting has its rows of form factors from.
class ShotRows {
public:
  /// Told whose turn it is next, the brightest first, so that their rows can be made at once.
  /// @param patches  valid until the next call
  virtual Status prepare(std::span<const std::uint32_t> patches) = 0;
  /// @param k    counts in what was prepared
  /// @param row  valid until the next call of either
  virtual Status row(std::size_t k, RowView* row) = 0;

protected:
  ~ShotRows() = default;
};

/// Progressive refinement without a matrix, shot by shot: the kRowsAtOnce brightest patches are
/// chosen at once, and shoot one after the other.
class Shooting {
public:
  static constexpr std::size_t kRowsAtOnce = 16;

  /// @param problem, rows  outlive this
  /// @param space          as RowShooter::init
  Status init(const LightProblem& problem, std::span<const double> space, ShotRows* rows);

  /// Adds up what is unshot: to be called before the first shot.
  /// @return kBadScene (light beyond the range of numbers)
  Status survey();

  /// The next shot; there must be unshot light.
  /// @return what the rows say, or survey()
  Status shoot();

  std::uint64_t shots() const noexcept { return shots_; }
  double unshot() const noexcept { return unshot_; } ///< share of what is emitted, worst band
  RowShooter& light() noexcept { return light_; }

private:
  ShotRows* rows_ = nullptr;
  RowShooter light_;
  std::uint32_t brightest_[kRowsAtOnce] = {};
  std::size_t next_ = 0, count_ = 0; ///< of the brightest: whose turn it is, how many there are
  std::uint64_t shots_ = 0;
  double unshot_ = 0;
};

} // namespace hemicube::radiosity
