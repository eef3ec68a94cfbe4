#pragma once

#include "radiosity/error_estimate.h"

namespace hemicube::radiosity {

/// Chooses the cheapest way to a wanted error: by the rows of a sample, computed once much more
/// exactly and then in each way that may do.
class Dial {
public:
  /// @param problem  the light whose error counts; null: the error of form factors counts
  Dial(RowGeometry* geometry, const LightProblem* problem, const Options& options,
       Executor& executor) noexcept
      : geometry_(geometry), problem_(problem), options_(options), executor_(executor) {}

  /// @param setting  what was asked for; what was left open is filled in
  Status choose(RungSetting* setting);

  /// To be called when a run with the chosen setting turned out to have a larger error than wanted.
  /// @return false if there is nothing finer to choose
  Status choose_finer(double found, RungSetting* setting, bool* is_finer);

private:
  struct Candidate {
    RungSetting setting;
    double error = 0; ///< predicted
    double cost = 0;  ///< of a row, about nanoseconds, guessed
    bool is_judged = false;
  };
  static constexpr std::size_t kMostCandidates = 16;

  void list_candidates(const RungSetting& wish);
  Status judge(Candidate* candidate);
  void order_by_cost(double exact_work, double seen);
  Status find_cheapest(double bound, std::size_t* found);
  double light_error(const FormFactorMatrix& rows);

  RowGeometry* geometry_;
  const LightProblem* problem_;
  const Options& options_;
  Executor& executor_;
  RowSample sample_;
  Buffer<double> defect_; ///< [band]
  Buffer<double> light_;  ///< [patch][band] a guess of B
  Candidate candidates_[kMostCandidates];
  std::size_t candidate_count_ = 0, chosen_ = 0;
};

} // namespace hemicube::radiosity
