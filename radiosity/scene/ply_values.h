#pragma once

#include "radiosity/scene/ply_header.h"
#include "radiosity/scene/text_cursor.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

// Where the values of a PLY file come from: one class for each way of writing them, with the same
// functions, in the order begin_item, then one call per value, then end_item, and end at last. All
// errors are kBadScene and name the place: PATH:LINE, or in binary files PATH: byte N.

/// What both have in common: the item at hand, for messages.
class PlyPlace {
public:
  explicit PlyPlace(const std::string& path) : path_(path) {}

protected:
  void set_item(const PlyElement& element, std::uint64_t item) {
    element_ = &element;
    item_ = item;
  }

  Status ended() const {
    return Status::error(StatusCode::kBadScene, path_, ": the header says ", element_->count, " x ",
                         in_quotes(element_->name), ", but the file ends after ", item_);
  }

  const std::string& path_;
  const PlyElement* element_ = nullptr;
  std::uint64_t item_ = 0;
};

/// An item a line; blank lines are skipped.
class PlyText : public PlyPlace {
public:
  PlyText(std::string_view bytes, const PlyHeader& header, const std::string& path)
      : PlyPlace(path), lines_(bytes.substr(header.size)), header_lines_(header.line_count) {}

  Status begin_item(const PlyElement& element, std::uint64_t item) {
    set_item(element, item);
    if (!lines_.next_with_words())
      return ended();
    line_ = lines_.line();
    return {};
  }

  Status coordinate(PlyType, double* value) {
    HC_TRY(take());
    return parse_coordinate(path_, line_number(), word_, value);
  }

  Status integer(PlyType, std::string_view what, std::int64_t* value) {
    HC_TRY(take());
    return parse_integer(word_, value) ? Status()
                                       : error(what, " ", in_quotes(word_), " is not an integer");
  }

  Status skip(PlyType) { return take(); }

  Status end_item() {
    return next_word(&line_).empty()
               ? Status()
               : error("there are more values than the properties of element ",
                       in_quotes(element_->name), " are");
  }

  Status end() {
    return lines_.next_with_words() ? error("the header says that the file ends before this line")
                                    : Status();
  }

  template <typename... Parts> Status error(const Parts&... parts) const {
    return error_at(path_, line_number(), parts...);
  }

private:
  std::uint64_t line_number() const { return header_lines_ + lines_.number(); }

  Status take() {
    word_ = next_word(&line_);
    return word_.empty() ? error("there are fewer values than the properties of element ",
                                 in_quotes(element_->name), " are")
                         : Status();
  }

  LineReader lines_;
  std::uint64_t header_lines_;
  std::string_view line_;
  std::string_view word_;
};

/// Values without gaps, in either byte order.
class PlyBinary : public PlyPlace {
public:
  PlyBinary(std::string_view bytes, const PlyHeader& header, const std::string& path)
      : PlyPlace(path), bytes_(bytes), at_(header.size),
        swap_((header.encoding == PlyHeader::Encoding::kBigEndian) !=
              (std::endian::native == std::endian::big)) {}

  Status begin_item(const PlyElement& element, std::uint64_t item) {
    set_item(element, item);
    return {};
  }

  Status coordinate(PlyType type, double* value) {
    switch (type) {
    case PlyType::kFloat32:
      HC_TRY(load<float>(value));
      break;
    case PlyType::kFloat64:
      HC_TRY(load<double>(value));
      break;
    default:
      std::int64_t whole = 0;
      HC_TRY(integer(type, "", &whole));
      *value = static_cast<double>(whole);
    }
    return std::isfinite(*value) ? Status()
                                 : error("vertex coordinate ", *value, " is not a finite number");
  }

  /// @param type  an integer type
  Status integer(PlyType type, std::string_view, std::int64_t* value) {
    switch (type) {
    case PlyType::kInt8:
      return load<std::int8_t>(value);
    case PlyType::kUint8:
      return load<std::uint8_t>(value);
    case PlyType::kInt16:
      return load<std::int16_t>(value);
    case PlyType::kUint16:
      return load<std::uint16_t>(value);
    case PlyType::kInt32:
      return load<std::int32_t>(value);
    default:
      return load<std::uint32_t>(value);
    }
  }

  Status skip(PlyType type) {
    const std::size_t count = byte_count(type);
    if (bytes_.size() - at_ < count)
      return ended();
    at_ += count;
    return {};
  }

  Status end_item() { return {}; }

  /// Bytes that are left mean that the header counts wrongly.
  Status end() const {
    return at_ == bytes_.size() ? Status()
                                : error("the header says that the file ends here, but ",
                                        bytes_.size() - at_, " bytes follow");
  }

  template <typename... Parts> Status error(const Parts&... parts) const {
    return Status::error(StatusCode::kBadScene, path_, ": byte ", at_, ": ", parts...);
  }

private:
  template <typename Stored, typename Value> Status load(Value* value) {
    if (bytes_.size() - at_ < sizeof(Stored))
      return ended();
    char raw[sizeof(Stored)];
    for (std::size_t k = 0; k < sizeof(Stored); ++k)
      raw[k] = bytes_[at_ + (swap_ ? sizeof(Stored) - 1 - k : k)];
    Stored stored;
    // cppcheck-suppress uninitvar ; Stored has bytes
    std::memcpy(&stored, raw, sizeof stored);
    // NOLINTNEXTLINE(bugprone-signed-char-misuse,cert-str34-c): the file says that it is signed
    *value = static_cast<Value>(stored);
    at_ += sizeof(Stored);
    return {};
  }

  std::string_view bytes_;
  std::size_t at_;
  bool swap_;
};

} // namespace hemicube::radiosity
