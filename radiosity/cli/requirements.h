#pragma once

#include "radiosity/cli/options.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity::cli {

/// What conditions are about: the certificate of a run, and what it does not hold.
struct CheckedRun {
  const Certificate& certificate;
  double closure_error = 0;          ///< max |row sum + space + back side - 1| over the rows
  std::string_view row_of = "patch"; ///< what a row is of: "patch", "element" or "point"
};

double closure_error(const Solution& solution);
Status closure_error(const FormFactorMatrix& matrix, double* error);

/// "closed, closure=X, ...": the conditions a command knows.
/// @param solves  whether it computes light
std::string known_conditions(bool solves);

/// Reads "closed,reciprocity=1e-6,...".
/// @param solves  whether the command computes light; else conditions on light are refused
/// Throws BadValue.
std::vector<Requirement> parse_requirements(std::string_view text, bool solves);

/// Refuses conditions on what the command line leaves out.
/// @return kInvalidArgument
Status check_applicable(const CommandLine& line);

/// An error that names every condition that does not hold, with what is and what must be.
/// @return kCheckFailed
Status check_requirements(std::span<const Requirement> requirements, const CheckedRun& run);

} // namespace hemicube::radiosity::cli
