#pragma once

#include "radiosity/cli/session.h"
#include "radiosity/forecast.h"

namespace hemicube::radiosity::cli {

/// What `solve` without -o would take with the same options, predicted.
struct RunCost {
  Forecast forecast;
  double nonzeros_per_row = 0;
  double matrix_bytes = 0;        ///< of the rows the solver keeps
  double memory_bytes = 0;        ///< at most, of the whole process
  double form_factor_seconds = 0; ///< rows alone
  double seconds = 0;             ///< from reading the scene to the certificate
};

/// Does a little of the run.
Status predict_cost(Session* session, RunCost* cost);

} // namespace hemicube::radiosity::cli
