#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/radiosity.h"
#include "radiosity/row_statistics.h"

namespace hemicube::radiosity {

/// Balances a matrix of all rows, and keeps what the certificate says true.
/// @param progress  may be null
/// @return as balance()
Status balance_rows(const PatchSet& patches, Executor& executor, Progress* progress,
                    FormFactorMatrix* matrix, RowStatistics* statistics, Certificate* certificate);

} // namespace hemicube::radiosity
