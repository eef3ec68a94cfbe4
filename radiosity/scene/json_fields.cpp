#include "radiosity/scene/json_fields.h"

#include "radiosity/scene/scene.h"

#include <algorithm>
#include <limits>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

std::string_view kind_name(Kind kind) {
  switch (kind) {
  case Kind::kNull:
    return "null";
  case Kind::kBoolean:
    return "true or false";
  case Kind::kNumber:
    return "a number";
  case Kind::kString:
    return "a text";
  case Kind::kArray:
    return "an array";
  case Kind::kObject:
    return "an object";
  }
  return "";
}

} // namespace

Status JsonFields::kind(const JsonValue& value, std::string_view what, Kind wanted) const {
  if (value.kind == wanted)
    return {};
  return error(value, what, " must be ", kind_name(wanted), ", not ", kind_name(value.kind));
}

Status JsonFields::object(const JsonValue& value, std::string_view what,
                          std::initializer_list<std::string_view> known) const {
  HC_TRY(kind(value, what, Kind::kObject));
  for (std::size_t i = 0; i < value.keys.size(); ++i) {
    if (std::find(known.begin(), known.end(), value.keys[i]) != known.end())
      continue;
    std::string choices;
    for (const std::string_view key : known)
      choices.append(choices.empty() ? "" : ", ").append(key);
    return error(value.items[i], what, ": unknown key ", in_quotes(value.keys[i]), "; known are ",
                 choices);
  }
  return {};
}

Status JsonFields::number(const JsonValue& value, std::string_view what, double* out) const {
  HC_TRY(kind(value, what, Kind::kNumber));
  *out = value.number;
  return {};
}

Status JsonFields::positive_number(const JsonValue& value, std::string_view what,
                                   double* out) const {
  HC_TRY(number(value, what, out));
  return *out > 0 ? Status() : error(value, what, " must be greater than 0, not ", *out);
}

Status JsonFields::boolean(const JsonValue& value, std::string_view what, bool* out) const {
  HC_TRY(kind(value, what, Kind::kBoolean));
  *out = value.boolean;
  return {};
}

Status JsonFields::name(const JsonValue& value, std::string_view what, std::string* out) const {
  HC_TRY(kind(value, what, Kind::kString));
  *out = value.text;
  return check_name(value, what, value.text);
}

Status JsonFields::check_name(const JsonValue& at, std::string_view what,
                              std::string_view text) const {
  if (text.empty())
    return error(at, what, " must not be empty");
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20)
      return error(at, what, " must not hold control characters: ", in_quotes(text));
  return {};
}

Status JsonFields::pixels(const JsonValue& value, std::string_view what, std::uint32_t* out) const {
  constexpr double kMost = Camera::kMaxSize;
  double count = 0;
  HC_TRY(number(value, what, &count));
  if (!(count >= 1 && count <= kMost && count == static_cast<std::uint32_t>(count)))
    return error(value, what, " must be a whole number from 1 to ", kMost, ", not ", count);
  *out = static_cast<std::uint32_t>(count);
  return {};
}

Status JsonFields::numbers(const JsonValue& value, std::string_view what, std::size_t count,
                           std::vector<double>* out) const {
  HC_TRY(kind(value, what, Kind::kArray));
  if (value.items.size() != count)
    return error(value, what, " must have ", count, count == 1 ? " number" : " numbers", ", not ",
                 value.items.size());
  out->assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    HC_TRY(number(value.items[i], what, &(*out)[i]));
  return {};
}

Status JsonFields::vector(const JsonValue& value, std::string_view what, Vec3* out) const {
  std::vector<double> xyz;
  HC_TRY(numbers(value, what, 3, &xyz));
  *out = {xyz[0], xyz[1], xyz[2]};
  return {};
}

Status JsonFields::per_band(const JsonValue& value, std::string_view what, std::uint32_t band_count,
                            double largest, std::vector<double>* out) const {
  if (value.kind == Kind::kNumber)
    out->assign(band_count, value.number);
  else if (value.kind == Kind::kArray)
    HC_TRY(numbers(value, what, band_count, out));
  else
    return error(value, what, " must be a number or an array of one per band, not ",
                 kind_name(value.kind));
  for (std::size_t i = 0; i < out->size(); ++i) {
    const JsonValue& place = value.kind == Kind::kArray ? value.items[i] : value;
    const double number = (*out)[i];
    if (number < 0 && largest == std::numeric_limits<double>::max())
      return error(place, what, " ", number, " is negative");
    if (number < 0 || number > largest)
      return error(place, what, " ", number, " is outside [0, ", largest, "]");
  }
  return {};
}

} // namespace hemicube::radiosity
