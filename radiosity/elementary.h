#pragma once

namespace hemicube::radiosity {

/// pi, rounded to double.
inline constexpr double kPi = 3.14159265358979323846;

/// The arc tangent of x, within 2 units in the last place, odd, -pi/2 .. pi/2. Only + - * /: the
/// libm of each system rounds differently, this does not. NaN gives NaN.
double arctangent(double x) noexcept;

} // namespace hemicube::radiosity
