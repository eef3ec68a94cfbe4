#include "radiosity/scene/gltf_file.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

namespace hemicube::radiosity {
namespace {

using Kind = JsonValue::Kind;

std::uint32_t load_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// The value of a hexadecimal digit, or -1.
int hex_digit(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The value of a base64 digit, or -1.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// %20 and the like.
std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    text += low >= 0 ? static_cast<char>(16 * high + low) : uri[i];
    i += low >= 0 ? 2 : 0;
  }
  return text;
}

} // namespace

bool decode_data_uri(std::string_view uri, std::string* bytes) {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  if (!uri.starts_with("data:") || mark == std::string_view::npos)
    return false;
  std::string_view text = uri.substr(mark + kMark.size());
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding)
    text.remove_suffix(1);
  bytes->reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0)
      return false;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes->push_back(static_cast<char>(bits >> bit_count & 0xff));
    }
  }
  return text.size() % 4 != 1;
}

Status GltfFile::open(std::initializer_list<std::string_view> extensions, ReadReport* report) {
  report_ = report;
  HC_TRY(read_file(fields_.path(), &bytes_));
  report_->add_file(fields_.path());
  std::string_view json = bytes_;
  const bool is_binary = has_extension(fields_.path(), ".glb");
  if (is_binary)
    HC_TRY(open_glb(&json));
  HC_TRY(parse_json(json, fields_.path(), &root_));
  if (!is_binary)
    bytes_ = {};
  HC_TRY(fields_.kind(root_, "the file", Kind::kObject));
  HC_TRY(check_asset());
  HC_TRY(check_extensions(extensions));
  std::size_t buffer_count = 0;
  HC_TRY(count("buffers", &buffer_count));
  buffers_.resize(buffer_count);
  return {};
}

/// A header of 12 bytes, then chunks: length, type, bytes. The first is the JSON; the next may be
/// the bytes of buffer 0.
Status GltfFile::open_glb(std::string_view* json) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  const std::string_view bytes = bytes_;
  const auto error = [&](const auto&... parts) {
    return Status::error(StatusCode::kBadScene, fields_.path(), ": ", parts...);
  };
  if (!bytes.starts_with("glTF"))
    return error("this is no GLB file: it does not begin with 'glTF'");
  if (bytes.size() < kHeader)
    return error("the file ends in its header, after ", bytes.size(), " bytes");
  if (load_u32(bytes, 4) != 2)
    return error("version ", load_u32(bytes, 4), " is not known; this program reads 2");
  if (load_u32(bytes, 8) != bytes.size())
    return error("the header says ", load_u32(bytes, 8), " bytes, but the file has ", bytes.size());
  bool has_json = false;
  for (std::size_t at = kHeader; at < bytes.size();) {
    if (bytes.size() - at < kChunkHeader)
      return error("byte ", at, ": the header of a chunk is cut off");
    const std::size_t length = load_u32(bytes, at), left = bytes.size() - at - kChunkHeader;
    const std::uint32_t type = load_u32(bytes, at + 4);
    if (length > left)
      return error("byte ", at, ": the chunk says ", length, " bytes, but ", left, " are left");
    const std::string_view chunk = bytes.substr(at + kChunkHeader, length);
    if (!has_json && type != kJson)
      return error("byte ", at, ": the first chunk is not JSON");
    if (!has_json)
      *json = chunk;
    else if (type == kBinary && !binary_chunk_)
      binary_chunk_ = chunk;
    else
      ++report_->skipped["chunks of a GLB file"];
    has_json = true;
    at += kChunkHeader + length;
  }
  return has_json ? Status() : error("there is no JSON chunk");
}

Status GltfFile::check_asset() const {
  const JsonValue *asset = nullptr, *version = nullptr;
  HC_TRY(required(root_, "", "asset", &asset));
  HC_TRY(fields_.kind(*asset, "asset", Kind::kObject));
  HC_TRY(required(*asset, "asset", "version", &version));
  for (const char* key : {"version", "minVersion"}) {
    const JsonValue* value = asset->find(key);
    if (value == nullptr)
      continue;
    const std::string what = std::string("asset.") + key;
    HC_TRY(fields_.kind(*value, what, Kind::kString));
    const bool is_known = value == version ? value->text.starts_with("2.") : value->text == "2.0";
    if (!is_known)
      return fields_.error(*value, what, ": ", in_quotes(value->text),
                           " is not known; this program reads 2.0");
  }
  return {};
}

Status GltfFile::check_extensions(std::initializer_list<std::string_view> extensions) const {
  const JsonValue* required_ones = root_.find("extensionsRequired");
  if (required_ones == nullptr)
    return {};
  HC_TRY(fields_.kind(*required_ones, "extensionsRequired", Kind::kArray));
  for (const JsonValue& name : required_ones->items) {
    HC_TRY(fields_.kind(name, "extensionsRequired", Kind::kString));
    if (std::find(extensions.begin(), extensions.end(), name.text) == extensions.end())
      return fields_.error(name, "extensionsRequired: ", in_quotes(name.text),
                           " is not supported: save the file without it");
  }
  return {};
}

Status GltfFile::required(const JsonValue& value, const std::string& what, const char* key,
                          const JsonValue** member) const {
  *member = value.find(key);
  if (*member != nullptr)
    return {};
  return fields_.error(value, what.empty() ? "the file" : what, " lacks the key '", key, "'");
}

Status GltfFile::count(const char* table, std::size_t* count) const {
  const JsonValue* items = root_.find(table);
  if (items != nullptr)
    HC_TRY(fields_.kind(*items, table, Kind::kArray));
  *count = items == nullptr ? 0 : items->items.size();
  return {};
}

Status GltfFile::whole_number(const JsonValue& value, const std::string& what,
                              std::uint64_t* out) const {
  double number = 0;
  HC_TRY(fields_.number(value, what, &number));
  if (!(number >= 0 && number <= 0x1p53 &&
        number == static_cast<double>(static_cast<std::uint64_t>(number))))
    return fields_.error(value, what, ": ", number, " is not a whole number from 0 on");
  *out = static_cast<std::uint64_t>(number);
  return {};
}

Status GltfFile::follow(const JsonValue& reference, const std::string& what, const char* table,
                        Item* item) const {
  std::uint64_t index = 0;
  std::size_t item_count = 0;
  HC_TRY(whole_number(reference, what, &index));
  HC_TRY(count(table, &item_count));
  if (index >= item_count)
    return fields_.error(reference, what, ": ", index, " is none of the ", item_count, " ", table);
  item->index = static_cast<std::uint32_t>(index);
  item->value = &root_.find(table)->items[index];
  item->what = std::string(table) + "[" + std::to_string(index) + "]";
  return fields_.kind(*item->value, item->what, Kind::kObject);
}

Status GltfFile::buffer(const Item& item, std::string_view* bytes) {
  const JsonValue* length_value = nullptr;
  std::uint64_t length = 0;
  HC_TRY(required(*item.value, item.what, "byteLength", &length_value));
  HC_TRY(whole_number(*length_value, item.what + ".byteLength", &length));
  std::optional<std::string>& loaded = buffers_[item.index];
  if (item.index == 0 && binary_chunk_ && item.value->find("uri") == nullptr) {
    *bytes = *binary_chunk_;
  } else {
    if (!loaded) {
      std::string fresh;
      HC_TRY(load_buffer(item, &fresh));
      loaded = std::move(fresh);
    }
    *bytes = *loaded;
  }
  if (length > bytes->size())
    return fields_.error(*length_value, item.what, ".byteLength: ", length,
                         " bytes are more than the ", bytes->size(), " that are there");
  *bytes = bytes->substr(0, length);
  return {};
}

Status GltfFile::load_buffer(const Item& item, std::string* bytes) {
  const std::string what = item.what + ".uri";
  const JsonValue* uri = item.value->find("uri");
  if (uri == nullptr)
    return fields_.error(*item.value, item.what,
                         " has no uri, and there is no binary chunk for it");
  HC_TRY(fields_.kind(*uri, what, Kind::kString));
  if (!uri->text.starts_with("data:"))
    return load_buffer_file(*uri, what, bytes);
  return decode_data_uri(uri->text, bytes)
             ? Status()
             : fields_.error(*uri, what, ": the data is not valid base64");
}

Status GltfFile::load_buffer_file(const JsonValue& uri, const std::string& what,
                                  std::string* bytes) {
  HC_TRY(fields_.check_name(uri, what, uri.text));
  if (uri.text.find("://") != std::string::npos)
    return fields_.error(uri, what, ": ", in_quotes(uri.text), " is not the name of a file");
  const auto folder = std::filesystem::path(fields_.path()).parent_path();
  const std::string file = (folder / percent_decoded(uri.text)).lexically_normal().string();
  if (const std::string why = why_no_file(file); !why.empty())
    return fields_.error(uri, what, ": ", in_quotes(uri.text), why, " (looked for ", file, ")");
  HC_TRY(read_file(file, bytes));
  report_->add_file(file);
  return {};
}

} // namespace hemicube::radiosity
