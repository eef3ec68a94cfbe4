#include "radiosity/scene/json_value.h"

#include "radiosity/scene/text_cursor.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <iterator>
#include <map>

namespace hemicube::radiosity {
namespace {

constexpr std::size_t kDeepest = 64;

/// Iterator over the text that shows how far the parser has read. The parser is at most one byte
/// ahead of the value it reports, and that byte, if it is a line end, still counts to the line it
/// ends.
struct WatchedIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** last_read;

  reference operator*() const {
    *last_read = at;
    return *at;
  }
  WatchedIterator& operator++() {
    ++at;
    return *this;
  }
  WatchedIterator operator++(int) {
    const WatchedIterator before = *this;
    ++at;
    return before;
  }
  bool operator==(const WatchedIterator& other) const { return at == other.at; }
};

/// Takes the parser's events and builds the tree.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
  TreeBuilder(std::string_view text, std::string_view path, JsonValue* root)
      : last_read_(text.data()), counted_(text.data()), path_(path), root_(root) {}

  const char** last_read() { return &last_read_; }
  const Status& status() const { return status_; }

  bool null() override {
    add(JsonValue::Kind::kNull);
    return true;
  }
  bool boolean(bool value) override {
    add(JsonValue::Kind::kBoolean)->boolean = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t, const string_t& digits) override;
  bool string(string_t& value) override {
    add(JsonValue::Kind::kString)->text = std::move(value);
    return true;
  }
  bool binary(binary_t&) override { return fail("binary data"); }
  bool start_object(std::size_t) override { return open(JsonValue::Kind::kObject); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::kArray); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override;
  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::detail::exception& problem) override;

private:
  struct Open {
    JsonValue* value; // stays where it is: its parent gets no sibling while it is open
    std::map<std::string, std::uint64_t> key_lines;
    std::uint64_t line; // of the last key
  };

  std::uint64_t line() {
    for (; counted_ < last_read_; ++counted_)
      if (*counted_ == '\n')
        ++line_;
    return line_;
  }
  template <typename... Parts> bool fail(const Parts&... parts) {
    status_ = error_at(path_, line(), parts...);
    return false;
  }
  JsonValue* add(JsonValue::Kind kind);
  bool number(double value) {
    add(JsonValue::Kind::kNumber)->number = value;
    return true;
  }
  bool open(JsonValue::Kind kind);
  bool close() {
    open_.pop_back();
    return true;
  }

  const char* last_read_;
  const char* counted_; // all lines before it are in line_
  std::uint64_t line_ = 1;
  std::string_view path_;
  JsonValue* root_;
  std::vector<Open> open_;
  Status status_;
};

JsonValue* TreeBuilder::add(JsonValue::Kind kind) {
  JsonValue* value = root_;
  std::uint64_t value_line = line();
  if (!open_.empty()) {
    Open& parent = open_.back();
    value = &parent.value->items.emplace_back();
    if (parent.value->kind == JsonValue::Kind::kObject)
      value_line = parent.line;
  }
  value->kind = kind;
  value->line = value_line;
  return value;
}

bool TreeBuilder::open(JsonValue::Kind kind) {
  if (open_.size() == kDeepest)
    return fail("nested deeper than ", kDeepest, " levels");
  open_.push_back({add(kind), {}, 0});
  return true;
}

bool TreeBuilder::key(string_t& value) {
  Open& object = open_.back();
  object.line = line();
  const auto [entry, is_new] = object.key_lines.emplace(value, object.line);
  if (!is_new)
    return fail("the key ", in_quotes(value), " is given twice, first on line ", entry->second);
  object.value->keys.push_back(std::move(value));
  return true;
}

/// Converted by our own function: the parser's depends on the locale, as does its decimal point.
bool TreeBuilder::number_float(number_float_t, const string_t& digits) {
  std::string portable = digits;
  for (char& c : portable)
    if ((c < '0' || c > '9') && c != '+' && c != '-' && c != 'e' && c != 'E')
      c = '.';
  double value = 0;
  if (parse_number(portable, &value) != NumberForm::kFinite)
    return fail("the number ", in_quotes(portable), " is not a finite number");
  return number(value);
}

/// The parser's message without its own prefix: "[json.exception...] parse error at line 1, column
/// 2: ".
bool TreeBuilder::parse_error(std::size_t, const std::string&,
                              const nlohmann::detail::exception& problem) {
  std::string_view what = problem.what();
  if (const std::size_t end = what.find("] "); end != std::string_view::npos)
    what.remove_prefix(end + 2);
  if (what.starts_with("parse error at "))
    if (const std::size_t end = what.find(": "); end != std::string_view::npos)
      what.remove_prefix(end + 2);
  return fail("not valid JSON: ", what);
}

} // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key)
      return &items[i];
  return nullptr;
}

Status parse_json(std::string_view text, const std::string& path, JsonValue* root) {
  return without_exceptions(path, [&]() -> Status {
    *root = {};
    TreeBuilder builder(text, path, root);
    const WatchedIterator begin{text.data(), builder.last_read()};
    const WatchedIterator end{text.data() + text.size(), builder.last_read()};
    nlohmann::json::sax_parse(begin, end, &builder);
    return builder.status();
  });
}

} // namespace hemicube::radiosity
