#include "radiosity/c_api/call.h"
#include "radiosity/c_api/handles.h"
#include "radiosity/form_factor/matrix_file.h"

namespace hemicube::radiosity::c_api {
namespace {

/// What all calls that compute rows do: compute(call, handle) fills matrix and certificate.
template <typename Compute>
int create(const hc_scene* scene, const hc_options* options, hc_form_factors** form_factors,
           Compute compute) noexcept {
  if (form_factors == nullptr)
    return finish(null_argument("form_factors"));
  *form_factors = nullptr;
  if (scene == nullptr)
    return finish(null_argument("scene"));
  const Held held(scene);
  NewHandle<hc_form_factors> made;
  const auto run = [&]() -> Status {
    Call call;
    HC_TRY(call.begin(options));
    HC_TRY(made.make());
    HC_TRY(compute(call, *made));
    made->certificate.scene_hash = scene->hash;
    made->geometry = hash_geometry(scene->patches);
    return {};
  };
  const Status status = run();
  if (status.ok())
    made.give(form_factors);
  return finish(status);
}

Status check_count(std::uint64_t count) noexcept {
  return count != 0 ? Status() : Status::error(StatusCode::kInvalidArgument, "count is 0");
}

Status read_points(const double* points, const double* normals, std::uint64_t count,
                   Buffer<Receiver>* receivers) noexcept {
  HC_TRY(check_count(count));
  if (points == nullptr || normals == nullptr)
    return null_argument(points == nullptr ? "points" : "normals");
  if (count > static_cast<std::size_t>(-1) / sizeof(Receiver))
    return Status::error(StatusCode::kInvalidArgument, "count: ", count, " do not fit in memory");
  HC_TRY(receivers->reserve(static_cast<std::size_t>(count)));
  for (std::size_t k = 0; k < count; ++k) {
    const double *p = points + 3 * k, *n = normals + 3 * k;
    HC_TRY(receivers->push_back({Vec3{p[0], p[1], p[2]}, Vec3{n[0], n[1], n[2]}}));
  }
  return {};
}

Status get_csr(const hc_form_factors* form_factors, std::uint64_t row_count,
               std::uint64_t nonzero_count, std::uint64_t* offsets, std::uint32_t* columns,
               double* values, double* space, double* back_side) noexcept {
  if (form_factors == nullptr)
    return null_argument("form_factors");
  const FormFactorMatrix& matrix = form_factors->matrix;
  if (row_count != matrix.row_count() || nonzero_count != matrix.nonzero_count())
    return Status::error(StatusCode::kInvalidArgument, "sizes are ", row_count, " rows and ",
                         nonzero_count, " entries, but there are ", matrix.row_count(), " and ",
                         matrix.nonzero_count());
  std::uint64_t at = 0;
  for (std::uint64_t i = 0; i < row_count; ++i) {
    const RowView row = matrix.row(i);
    if (offsets != nullptr)
      offsets[i] = at;
    for (std::size_t k = 0; k < row.columns.size(); ++k, ++at) {
      if (columns != nullptr)
        columns[at] = row.columns[k];
      if (values != nullptr)
        values[at] = row.scale * static_cast<double>(row.values[k]);
    }
    if (space != nullptr)
      space[i] = row.space;
    if (back_side != nullptr)
      back_side[i] = row.back_side;
  }
  if (offsets != nullptr)
    offsets[row_count] = at;
  return {};
}

class CallbackSink final : public RowSink {
public:
  CallbackSink(hc_row_callback callback, void* context) : callback_(callback), context_(context) {}

  Status take(std::uint64_t patch, const RowView& row) noexcept override {
    const hc_row given = {sizeof(hc_row),    patch,     row.columns.size(), row.columns.data(),
                          row.values.data(), row.scale, row.space,          row.back_side};
    return callback_(context_, &given) == 0
               ? Status()
               : Status::error(StatusCode::kCancelled, "interrupted at row ", patch);
  }

private:
  hc_row_callback callback_;
  void* context_;
};

Status for_each_row(const hc_scene* scene, const hc_options* options, hc_row_callback callback,
                    void* context, hc_certificate* certificate) noexcept {
  if (scene == nullptr || callback == nullptr)
    return null_argument(scene == nullptr ? "scene" : "callback");
  const Held held(scene);
  hc_certificate known;
  if (certificate != nullptr)
    HC_TRY(read_struct("certificate", certificate, sizeof(hc_certificate), &known));
  Call call;
  HC_TRY(call.begin(options));
  CallbackSink sink(callback, context);
  Certificate filled;
  HC_TRY(stream_form_factors(scene->patches, call.options(), call.executor(), call.progress(),
                             &sink, &filled));
  filled.scene_hash = scene->hash;
  return certificate != nullptr ? write_certificate(filled, certificate) : Status();
}

} // namespace
} // namespace hemicube::radiosity::c_api

using namespace hemicube;
using namespace hemicube::radiosity;
using namespace hemicube::radiosity::c_api;

int hc_form_factors_create(hc_scene* scene, const hc_options* options,
                           hc_form_factors** form_factors) {
  return create(scene, options, form_factors, [&](Call& call, hc_form_factors& made) {
    made.are_all = true;
    return compute_form_factors(scene->patches, {}, call.options(), call.executor(),
                                call.progress(), &made.matrix, &made.certificate);
  });
}

int hc_patch_form_factors_create(hc_scene* scene, const uint32_t* patches, uint64_t count,
                                 const hc_options* options, hc_form_factors** form_factors) {
  return create(scene, options, form_factors, [&](Call& call, hc_form_factors& made) -> Status {
    HC_TRY(check_count(count));
    Buffer<std::uint32_t> rows;
    HC_TRY(copy_array("patches", patches, count, &rows));
    return compute_form_factors(scene->patches, rows.span(), call.options(), call.executor(),
                                call.progress(), &made.matrix, &made.certificate);
  });
}

int hc_point_form_factors_create(hc_scene* scene, const double* points, const double* normals,
                                 uint64_t count, const hc_options* options,
                                 hc_form_factors** form_factors) {
  return create(scene, options, form_factors, [&](Call& call, hc_form_factors& made) -> Status {
    Buffer<Receiver> receivers;
    HC_TRY(read_points(points, normals, count, &receivers));
    return compute_point_form_factors(scene->patches, receivers.span(), call.options(),
                                      call.executor(), call.progress(), &made.matrix,
                                      &made.certificate);
  });
}

void hc_form_factors_release(hc_form_factors* form_factors) {
  release_handle(form_factors);
}

int hc_form_factors_get_size(const hc_form_factors* form_factors, uint64_t* rows, uint64_t* columns,
                             uint64_t* nonzeros) {
  if (form_factors == nullptr)
    return finish(null_argument("form_factors"));
  const FormFactorMatrix& matrix = form_factors->matrix;
  if (rows != nullptr)
    *rows = matrix.row_count();
  if (columns != nullptr)
    *columns = matrix.column_count();
  if (nonzeros != nullptr)
    *nonzeros = matrix.nonzero_count();
  return HC_OK;
}

int hc_form_factors_get_csr(const hc_form_factors* form_factors, uint64_t row_count,
                            uint64_t nonzero_count, uint64_t* offsets, uint32_t* columns,
                            double* values, double* space, double* back_side) {
  return finish(
      get_csr(form_factors, row_count, nonzero_count, offsets, columns, values, space, back_side));
}

int hc_form_factors_get_certificate(const hc_form_factors* form_factors,
                                    hc_certificate* certificate) {
  return finish(form_factors != nullptr ? write_certificate(form_factors->certificate, certificate)
                                        : null_argument("form_factors"));
}

int hc_form_factors_for_each(hc_scene* scene, const hc_options* options, hc_row_callback callback,
                             void* context, hc_certificate* certificate) {
  return finish(for_each_row(scene, options, callback, context, certificate));
}
