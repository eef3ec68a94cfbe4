#pragma once

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/prepared_area.h"

namespace hemicube::radiosity {

/// The quick way for the common pair: two parallelograms well apart, each in front of the other, by
/// a small Gauss-Legendre rule; and pairs that see nothing of each other.
/// @param result  receives value and error, in m^2
/// @return false, and `result` untouched, if the pair needs another method
bool far_exchange(const PreparedArea& p, const PreparedArea& q, double relative_error,
                  AreaIntegral* result) noexcept;

} // namespace hemicube::radiosity
