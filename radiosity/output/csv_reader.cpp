#include "radiosity/output/csv_reader.h"

namespace hemicube::radiosity {

bool CsvReader::next(std::vector<std::string>* fields) {
  fields->clear();
  while (at_ < text_.size() && at_line_end()) { // empty lines
    line_ += text_[at_] == '\n';
    ++at_;
  }
  if (at_ == text_.size())
    return false;
  record_line_ = line_;
  for (;;) {
    read_field(&fields->emplace_back());
    if (at_line_end())
      return true;
    ++at_; // the comma
  }
}

void CsvReader::read_field(std::string* field) {
  bool quoted = false;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (!quoted && (c == ',' || at_line_end()))
      return;
    line_ += c == '\n';
    if (c != '"') {
      field->push_back(c);
    } else if (quoted && at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
      field->push_back('"');
      ++at_;
    } else {
      quoted = !quoted;
    }
  }
}

} // namespace hemicube::radiosity
