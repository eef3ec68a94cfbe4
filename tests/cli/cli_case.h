#pragma once

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace hemicube::test {

/// The inside of the unit cube: face 0 floor, 1 ceiling (the light), 2 .. 5 walls.
inline constexpr std::string_view kRoomObj = "mtllib room.mtl\n"
                                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                             "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                             "usemtl white\nf 1 2 3 4\n"
                                             "usemtl light\nf 5 8 7 6\n"
                                             "usemtl red\nf 1 4 8 5\n"
                                             "usemtl white\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n";
inline constexpr std::string_view kRoomMtl = "newmtl white\nKd 0.5 0.5 0.5\n"
                                             "newmtl light\nKd 0 0 0\nKe 10 10 10\n"
                                             "newmtl red\nKd 0.6 0.1 0.1\n";

/// A temporary folder with input files, in which the program is run.
class CliCase : public ::testing::Test {
protected:
  void SetUp() override;
  void TearDown() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes an input file and returns its path.
  std::string write(const std::string& name, std::string_view bytes);
  /// Writes room.obj and room.mtl, with other bytes in either where given.
  std::string write_room(std::string_view obj = kRoomObj, std::string_view mtl = kRoomMtl);

  std::string read(const std::string& name) const;

  /// The files that are there and were not written by write(), hidden ones too; folders end in '/'.
  std::set<std::string> new_files() const;

  /// Runs the program and expects an exit code.
  ProgramResult run(int exit_code, const std::vector<std::string>& arguments,
                    const ProgramSetting& setting = {}) const;

  /// Runs the program, expects an exit code, one line on stderr that starts with "hemicube: " and
  /// holds all of `parts`, nothing on stdout and nothing written.
  void expect_refused(int exit_code, const std::vector<std::string>& arguments,
                      const std::vector<std::string>& parts,
                      const ProgramSetting& setting = {}) const;

private:
  std::filesystem::path folder_;
  std::set<std::string> inputs_;
};

/// The lines of a text.
std::vector<std::string> lines_of(const std::string& text);

/// The values of a column of a CSV text that has no quoted fields.
std::vector<std::string> column_of(const std::string& csv, const std::string& name);

} // namespace hemicube::test
