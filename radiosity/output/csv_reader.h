#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// Splits CSV text into records. Fields in quotes may hold commas, line breaks and doubled quotes;
/// lines end in LF or CR LF; empty lines are skipped.
class CsvReader {
public:
  /// @param text  must outlive the reader; a byte order mark at its beginning is skipped
  explicit CsvReader(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf"))
      text_.remove_prefix(3);
  }

  /// The next record, or false at the end. An unclosed quote ends with the text.
  bool next(std::vector<std::string>* fields);

  /// The 1-based line the last record began on.
  std::uint64_t line() const { return record_line_; }

private:
  void read_field(std::string* field);
  bool at_line_end() const {
    return at_ == text_.size() || text_[at_] == '\n' ||
           (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n');
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1, record_line_ = 0;
};

} // namespace hemicube::radiosity
