#pragma once

#include "radiosity/scene/json_value.h"
#include "radiosity/scene/text_cursor.h"
#include "raster/math.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// Takes values of the wanted kind out of a JSON file. `what` names the value in messages, as in
/// "material 'red': reflectance". All errors are kBadScene `PATH:LINE: ...`.
class JsonFields {
public:
  /// @param path  of the file, for messages; must outlive this
  explicit JsonFields(const std::string& path) : path_(path) {}

  const std::string& path() const { return path_; }

  template <typename... Parts> Status error(const JsonValue& at, const Parts&... parts) const {
    return error_at(path_, at.line, parts...);
  }

  /// Refuses what is no object, and keys that are not among `known`.
  Status object(const JsonValue& value, std::string_view what,
                std::initializer_list<std::string_view> known) const;

  /// Refuses what is no array or object of the wanted kind.
  Status kind(const JsonValue& value, std::string_view what, JsonValue::Kind wanted) const;

  Status number(const JsonValue& value, std::string_view what, double* out) const;
  Status positive_number(const JsonValue& value, std::string_view what, double* out) const;
  Status boolean(const JsonValue& value, std::string_view what, bool* out) const;

  /// Text that is not empty and holds no control characters.
  Status name(const JsonValue& value, std::string_view what, std::string* out) const;

  /// Refuses what name() refuses in a text from elsewhere, such as a key.
  Status check_name(const JsonValue& at, std::string_view what, std::string_view text) const;

  /// A whole number from 1 to 65536.
  Status pixels(const JsonValue& value, std::string_view what, std::uint32_t* out) const;

  /// An array of exactly `count` numbers.
  Status numbers(const JsonValue& value, std::string_view what, std::size_t count,
                 std::vector<double>* out) const;
  Status vector(const JsonValue& value, std::string_view what, Vec3* out) const;

  /// One number for all bands or an array of one per band, each from 0 to `largest`.
  Status per_band(const JsonValue& value, std::string_view what, std::uint32_t band_count,
                  double largest, std::vector<double>* out) const;

private:
  const std::string& path_;
};

} // namespace hemicube::radiosity
