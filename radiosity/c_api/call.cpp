#include "radiosity/c_api/call.h"

#include "radiosity/c_api/handles.h"

namespace hemicube::radiosity::c_api {
namespace {

constexpr std::uint32_t kMaxWorkers = 1024, kMinResolution = 16, kMaxResolution = 2048;

template <typename... Parts> Status refuse(const Parts&... parts) noexcept {
  return Status::error(StatusCode::kInvalidArgument, "options: ", parts...);
}

/// 0 leaves a value as it is.
Status set_fraction(const char* name, double given, double* value) noexcept {
  if (given == 0)
    return {};
  if (!(given > 0 && given < 1))
    return refuse(name, " is ", given, ", not in 0..1");
  *value = given;
  return {};
}

Status set_flag(const char* name, std::int32_t given, bool if_set, bool* value) noexcept {
  if (given != 0 && given != 1)
    return refuse(name, " is ", given, ", neither 0 nor 1");
  *value = given == 1 ? if_set : !if_set;
  return {};
}

Status check_range(const char* name, std::int32_t given, std::int32_t last) noexcept {
  return given >= 0 && given <= last ? Status() : refuse(name, " is ", given, ", not in 0..", last);
}

} // namespace

Status Call::begin(const hc_options* options) noexcept {
  if (options != nullptr)
    HC_TRY(read_struct("options", options, sizeof(hc_options), &given_));
  HC_TRY(set_options());
  return set_workers();
}

Status Call::set_options() noexcept {
  const hc_options& g = given_;
  Options& o = options_;
  HC_TRY(check_range("rung", g.rung, HC_RUNG_EXACT));
  HC_TRY(check_range("solver", g.solver, HC_SOLVER_PROGRESSIVE));
  o.choose_rung = g.rung == HC_RUNG_CHOSEN;
  if (!o.choose_rung)
    o.rung = static_cast<Rung>(g.rung - HC_RUNG_HEMICUBE);
  o.solver = static_cast<SolverKind>(g.solver);
  o.choose_resolution = g.resolution == 0;
  if (!o.choose_resolution) {
    if (g.resolution < kMinResolution || g.resolution > kMaxResolution || g.resolution % 2 != 0)
      return refuse("resolution is ", g.resolution, ", not even or not in ", kMinResolution, "..",
                    kMaxResolution);
    o.resolution = g.resolution;
  }
  HC_TRY(set_fraction("error", g.error, &o.error));
  HC_TRY(set_fraction("tolerance", g.tolerance, &o.tolerance));
  HC_TRY(set_fraction("stop_unshot", g.stop_unshot, &o.stop_unshot));
  HC_TRY(set_flag("balance", g.balance, true, &o.balance));
  HC_TRY(set_flag("no_error_estimate", g.no_error_estimate, false, &o.estimate_error));
  HC_TRY(set_flag("no_black_irradiance", g.no_black_irradiance, false, &o.black_irradiance));
  if (g.max_sweeps != 0)
    o.max_sweeps = g.max_sweeps;
  if (g.max_shots != 0)
    o.max_shots = g.max_shots;
  if (g.isa == nullptr)
    return {};
  o.kernels = raster::kernels_by_name(g.isa);
  return o.kernels != nullptr
             ? Status()
             : refuse("isa \"", g.isa, "\": this machine or build does not have it");
}

Status Call::set_workers() noexcept {
  if (given_.executor != nullptr) {
    hc_executor executor;
    HC_TRY(read_struct("executor", given_.executor, sizeof(hc_executor), &executor));
    if (executor.run == nullptr)
      return null_argument("run of the executor");
    if (executor.worker_count == 0 || executor.worker_count > kMaxWorkers)
      return refuse("executor: worker_count is ", executor.worker_count, ", not in 1..",
                    kMaxWorkers);
    workers_ = &callers_;
    return callers_.init(executor);
  }
  if (given_.threads > kMaxWorkers)
    return refuse("threads are ", given_.threads, ", not in 1..", kMaxWorkers);
  workers_ = &own_;
#if defined(HC_NO_THREADS)
  return given_.threads <= 1 ? Status() : refuse("threads: this build has none, bring an executor");
#else
  return own_.init(given_.threads);
#endif
}

bool Call::tell(int stage, std::uint64_t done, std::uint64_t total, double error) const noexcept {
  if (given_.progress == nullptr)
    return !is_cancelled();
  const hc_progress progress = {sizeof(hc_progress), stage, done, total, error};
  return given_.progress(given_.context, &progress) == 0;
}

Status Call::run(std::size_t block_count, Block block, void* context) noexcept {
  if (given_.is_cancelled == nullptr)
    return workers_->run(block_count, block, context);
  return workers_->for_each(block_count, [&](std::size_t index, std::size_t worker) {
    return is_cancelled() ? Status::error(StatusCode::kCancelled, "interrupted by the caller")
                          : block(context, index, worker);
  });
}

} // namespace hemicube::radiosity::c_api
