#include "tests/cli/cli_case.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace hemicube::test {

namespace fs = std::filesystem;

void CliCase::SetUp() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::temp_directory_path() / ("hemicube_cli_" + std::string(test->test_suite_name()) +
                                         "_" + test->name() + "_" + std::to_string(::getpid()));
  fs::create_directories(folder_);
}

void CliCase::TearDown() {
  fs::remove_all(folder_);
}

std::string CliCase::write(const std::string& name, std::string_view bytes) {
  std::ofstream file(path(name), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  inputs_.insert(name);
  return path(name);
}

std::string CliCase::write_room(std::string_view obj, std::string_view mtl) {
  write("room.mtl", mtl);
  return write("room.obj", obj);
}

std::string CliCase::read(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  EXPECT_TRUE(file) << name << " is missing";
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

std::set<std::string> CliCase::new_files() const {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_)) {
    const std::string name = fs::relative(entry.path(), folder_).string();
    if (inputs_.count(name) == 0)
      names.insert(entry.is_directory() ? name + "/" : name);
  }
  return names;
}

ProgramResult CliCase::run(int exit_code, const std::vector<std::string>& arguments,
                           const ProgramSetting& setting) const {
  ProgramResult result = run_hemicube(arguments, setting);
  EXPECT_EQ(result.exit_code, exit_code)
      << "stderr: " << result.err << "arguments: " << ::testing::PrintToString(arguments);
  return result;
}

void CliCase::expect_refused(int exit_code, const std::vector<std::string>& arguments,
                             const std::vector<std::string>& parts,
                             const ProgramSetting& setting) const {
  const ProgramResult result = run(exit_code, arguments, setting);
  EXPECT_TRUE(result.err.starts_with("hemicube: ")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos)
        << "expected '" << part << "' in: " << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(new_files(), std::set<std::string>());
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

std::vector<std::string> column_of(const std::string& csv, const std::string& name) {
  std::vector<std::vector<std::string>> records;
  for (const std::string& line : lines_of(csv)) {
    std::vector<std::string>& fields = records.emplace_back();
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
      fields.push_back(field);
  }
  std::vector<std::string> values;
  if (records.empty())
    return values;
  const std::vector<std::string>& header = records.front();
  const auto found = std::find(header.begin(), header.end(), name);
  const auto column = static_cast<std::size_t>(found - header.begin());
  for (std::size_t k = 1; found != header.end() && k < records.size(); ++k)
    values.push_back(column < records[k].size() ? records[k][column] : "");
  return values;
}

} // namespace hemicube::test
