#include "radiosity/scene/text_cursor.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace hemicube::radiosity {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// A comment never continues: "# C:\textures\" must not swallow the line after it.
bool ends_in_backslash(std::string_view line) {
  const std::string_view words = trimmed(line);
  return !words.empty() && words.back() == '\\' && words.front() != '#';
}

std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return plus ? word.substr(1) : word;
}

/// Whether a number that fits no double is too large for it, not too small: looks at the decimal
/// order of its first digit that is not zero.
bool is_too_large(std::string_view number) {
  const std::size_t mantissa_end = std::min(number.find_first_of("eE"), number.size());
  const std::string_view mantissa = number.substr(0, mantissa_end);
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  std::int64_t exponent = 0;
  if (mantissa_end < number.size() && !parse_integer(number.substr(mantissa_end + 1), &exponent))
    return number[mantissa_end + 1] != '-';
  // Compared, not added: the exponent may be as large as an integer can be.
  return exponent > first - point;
}

std::string system_message(int code) {
  return std::generic_category().message(code);
}

} // namespace

std::string why_no_file(const std::string& path) {
  std::error_code problem;
  const auto type = std::filesystem::status(path, problem).type();
  if (type == std::filesystem::file_type::not_found)
    return " does not exist";
  if (problem)
    return " cannot be read: " + problem.message();
  if (type == std::filesystem::file_type::regular)
    return "";
  return type == std::filesystem::file_type::directory ? " is a directory, not a file"
                                                       : " is a pipe or device, not a file";
}

Status read_file(const std::string& path, std::string* bytes) {
  return without_exceptions(path, [&]() -> Status {
    if (const std::string why = why_no_file(path); !why.empty())
      return Status::error(StatusCode::kBadScene, path, ":", why);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (file == nullptr)
      return Status::error(StatusCode::kBadScene, path,
                           ": cannot be opened: ", system_message(errno));
    // One byte more than the file has, so that the end is met without growing.
    bytes->resize(static_cast<std::size_t>(std::filesystem::file_size(path)) + 1);
    std::size_t size = 0;
    while (const std::size_t got =
               std::fread(bytes->data() + size, 1, bytes->size() - size, file.get())) {
      size += got;
      if (size == bytes->size())
        bytes->resize(2 * size);
    }
    if (std::ferror(file.get()))
      return Status::error(StatusCode::kIo, path, ": reading failed after ", size,
                           " bytes: ", system_message(errno));
    bytes->resize(size);
    return {};
  });
}

bool has_extension(std::string_view path, std::string_view extension) {
  if (path.size() < extension.size())
    return false;
  const std::string_view end = path.substr(path.size() - extension.size());
  return std::equal(end.begin(), end.end(), extension.begin(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

Status check_is_text(std::string_view bytes, std::string_view path, std::string_view kind) {
  const auto never_in_text = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && !is_blank(c);
  };
  const auto bad = std::find_if(bytes.begin(), bytes.end(), never_in_text);
  if (bad == bytes.end())
    return {};
  return error_at(path, static_cast<std::uint64_t>(std::count(bytes.begin(), bad, '\n')) + 1,
                  "this does not look like ", kind, ": the line holds a byte of value ",
                  static_cast<int>(*bad));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  const bool is_long = text.size() > kLongest;
  return "'" + std::string(text.substr(0, kLongest)) + (is_long ? "...'" : "'");
}

LineReader::LineReader(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xef\xbb\xbf"))
    rest_.remove_prefix(3);
}

bool LineReader::next() {
  if (rest_.empty())
    return false;
  number_ = lines_read_ + 1;
  line_ = physical_line();
  if (!ends_in_backslash(line_))
    return true;
  joined_.clear();
  while (ends_in_backslash(line_)) {
    joined_.append(line_.substr(0, line_.rfind('\\')));
    joined_ += ' ';
    line_ = physical_line();
  }
  joined_.append(line_);
  line_ = joined_;
  return true;
}

bool LineReader::next_with_words() {
  while (next()) {
    std::string_view rest = line_;
    if (!next_word(&rest).empty())
      return true;
  }
  return false;
}

/// The line at the front of the rest, which may be empty.
std::string_view LineReader::physical_line() {
  std::size_t end = 0;
  while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r')
    ++end;
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.starts_with("\r\n"))
    rest_.remove_prefix(2);
  else if (!rest_.empty())
    rest_.remove_prefix(1);
  ++lines_read_;
  return line;
}

std::string_view next_word(std::string_view* line) {
  std::size_t begin = 0;
  while (begin < line->size() && is_blank((*line)[begin]))
    ++begin;
  if (begin == line->size() || (*line)[begin] == '#') {
    *line = {};
    return {};
  }
  std::size_t end = begin;
  while (end < line->size() && !is_blank((*line)[end]))
    ++end;
  const std::string_view word = line->substr(begin, end - begin);
  line->remove_prefix(end);
  return word;
}

std::string_view rest_as_name(std::string_view line) {
  for (std::size_t i = line.find('#'); i < line.size(); i = line.find('#', i + 1)) {
    const bool blank_before = i == 0 || is_blank(line[i - 1]);
    const bool blank_behind = i + 1 == line.size() || is_blank(line[i + 1]);
    if (blank_before && blank_behind) {
      line = line.substr(0, i);
      break;
    }
  }
  return trimmed(line);
}

NumberForm parse_number(std::string_view word, double* value) {
  const std::string_view number = without_plus(word);
  double parsed = 0;
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), parsed);
  if (problem == std::errc::invalid_argument || end != number.data() + number.size())
    return NumberForm::kNotANumber;
  if (problem == std::errc::result_out_of_range) {
    if (is_too_large(number))
      return NumberForm::kNotFinite;
    parsed = number.front() == '-' ? -0.0 : 0.0;
  }
  if (!std::isfinite(parsed))
    return NumberForm::kNotFinite;
  *value = parsed;
  return NumberForm::kFinite;
}

Status parse_coordinate(std::string_view path, std::uint64_t line, std::string_view word,
                        double* value) {
  const NumberForm form = parse_number(word, value);
  if (form == NumberForm::kFinite)
    return {};
  return error_at(path, line, "vertex coordinate ", in_quotes(word),
                  form == NumberForm::kNotANumber ? " is not a number" : " is not a finite number");
}

bool parse_integer(std::string_view word, std::int64_t* value) {
  const std::string_view number = without_plus(word);
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), *value);
  return problem == std::errc() && end == number.data() + number.size();
}

} // namespace hemicube::radiosity
