#include "radiosity/solve/shooting.h"

#include "raster/fp_environment.h"

#include <cmath>

namespace hemicube::radiosity {

Status Shooting::init(const LightProblem& problem, std::span<const double> space, ShotRows* rows) {
  rows_ = rows;
  next_ = count_ = 0;
  shots_ = 0;
  return light_.init(problem, space);
}

Status Shooting::survey() {
  UnshotLight& unshot = light_.unshot();
  unshot.survey();
  unshot_ = unshot.share();
  if (!std::isfinite(unshot_))
    return Status::error(StatusCode::kBadScene, "the light is too bright to be computed: scale ",
                         "the exitances down");
  return {};
}

Status Shooting::shoot() {
  if (next_ == count_) {
    next_ = 0;
    count_ = light_.unshot().choose(brightest_);
    HC_TRY(rows_->prepare({brightest_, count_}));
  }
  RowView row;
  HC_TRY(rows_->row(next_, &row));
  const FloatEnvironment environment;
  light_.shoot(brightest_[next_], row);
  ++next_;
  ++shots_;
  return survey();
}

} // namespace hemicube::radiosity
