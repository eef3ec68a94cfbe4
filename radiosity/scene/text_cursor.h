#pragma once

#include "raster/status.h"

#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

// What the readers of line-based text (OBJ, MTL, PLY, OFF, STL) and of JSON share.

/// Why a path cannot be read as a file, behind its name: " does not exist", " is a directory, not a
/// file"; empty where nothing is in the way.
std::string why_no_file(const std::string& path);

/// Reads a whole file as it is, byte for byte.
/// @return kBadScene if it is missing, unreadable or not a regular file (a directory, a pipe, a
/// device
///         that never ends); kIo if reading breaks off; kOutOfMemory
Status read_file(const std::string& path, std::string* bytes);

/// Whether a path ends in an extension such as ".obj", given in lower case, in any case.
bool has_extension(std::string_view path, std::string_view extension);

/// Refuses bytes that no text file has, such as NUL: kBadScene `PATH:LINE: ...`.
/// @param kind  what the file should be, as in "an OBJ file"
Status check_is_text(std::string_view bytes, std::string_view path, std::string_view kind);

/// kBadScene with the message `PATH:LINE: parts...`.
template <typename... Parts>
Status error_at(std::string_view path, std::uint64_t line, const Parts&... parts) noexcept {
  return Status::error(StatusCode::kBadScene, path, ":", line, ": ", parts...);
}

/// Text from a file for use in a message: in quotes, cut when long.
std::string in_quotes(std::string_view text);

/// Runs a reader whose library calls may throw, and turns what they throw into a Status.
template <typename Body> Status without_exceptions(const std::string& path, Body&& body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return Status::error(StatusCode::kOutOfMemory, path, ": out of memory while reading");
  } catch (const std::exception& problem) {
    return Status::error(StatusCode::kIo, path, ": cannot be read: ", problem.what());
  }
}

/// The lines of a text. A byte order mark is skipped; lines end in LF, CR LF or CR, the last one
/// also without; a backslash at the end of a line that is not a comment joins the next one to it.
class LineReader {
public:
  /// @param text  must outlive the reader
  explicit LineReader(std::string_view text);

  /// Moves to the next line; false at the end.
  bool next();

  /// Moves to the next line that holds a word: neither blank nor a comment.
  bool next_with_words();

  /// The current line without its end; valid until next().
  std::string_view line() const { return line_; }
  /// Its number, from 1; of a joined line, that of its first part.
  std::uint64_t number() const { return number_; }

private:
  std::string_view physical_line();

  std::string_view rest_;
  std::string_view line_;
  std::string joined_;
  std::uint64_t number_ = 0;
  std::uint64_t lines_read_ = 0;
};

/// Takes the next word off the front of `line`; empty at the end of the line or at a comment.
std::string_view next_word(std::string_view* line);

/// The rest of a line as a name, which may hold spaces and '#' ("Material #25"), without a comment
/// behind it: a comment starts at a '#' that has blanks on both sides.
std::string_view rest_as_name(std::string_view line);

enum class NumberForm { kFinite, kNotFinite, kNotANumber };

/// Reads a whole word as the nearest double, independent of the locale; a leading '+' is allowed,
/// and what is too small for a double is 0. `value` is filled for kFinite only.
NumberForm parse_number(std::string_view word, double* value);

/// Reads a whole word as a coordinate of a vertex.
/// @return kBadScene `PATH:LINE: ...` for what is not a finite number
Status parse_coordinate(std::string_view path, std::uint64_t line, std::string_view word,
                        double* value);

/// Reads a whole word as a decimal integer; false if it is none or does not fit.
bool parse_integer(std::string_view word, std::int64_t* value);

} // namespace hemicube::radiosity
