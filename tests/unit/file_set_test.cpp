#include "radiosity/output/file_set.h"

#include "radiosity/output/file_writer.h"
#include "radiosity/output/matrix_market.h"
#include "tests/unit/output_support.h"

namespace hemicube::radiosity::test {
namespace {

using FileSetTest = OutputFolder;
using Names = std::vector<std::string>;

TEST_F(FileSetTest, FilesAppearTogetherAtCommit) {
  FileSet files;
  require(files.begin(path("a/b/"))); // parents are made
  require(files.add("one.csv", "1"));
  { std::ofstream(files.path_for("two.png")) << "2"; }
  EXPECT_FALSE(std::filesystem::exists(path("a/b/one.csv")));
  require(files.commit());
  EXPECT_EQ(read(path("a/b/one.csv")), "1");
  EXPECT_EQ(read(path("a/b/two.png")), "2");
  const std::filesystem::directory_iterator folder(path("a/b"));
  EXPECT_EQ(std::distance(begin(folder), end(folder)), 2) << "something was left behind";
}

TEST_F(FileSetTest, WithoutCommitNothingChanges) {
  { std::ofstream(path("old.txt")) << "old"; }
  {
    FileSet files;
    require(files.begin(folder_.string()));
    require(files.add("old.txt", "new"));
    require(files.add("more.txt", "new"));
  }
  EXPECT_EQ(names(), Names{"old.txt"});
  EXPECT_EQ(read(path("old.txt")), "old");
}

TEST_F(FileSetTest, AFolderMadeForNothingIsRemoved) {
  {
    FileSet files;
    require(files.begin(path("made")));
    require(files.add("file.txt", "new"));
  }
  EXPECT_EQ(names(), Names{});
}

TEST_F(FileSetTest, TemporaryNamesKeepTheExtension) {
  FileSet files;
  require(files.begin(folder_.string()));
  EXPECT_EQ(std::filesystem::path(files.path_for("view.exr")).extension(), ".exr");
}

TEST_F(FileSetTest, AFileInPlaceOfTheFolderIsRefused) {
  { std::ofstream(path("taken")) << "x"; }
  FileSet files;
  for (const char* folder : {"taken", "taken/inside"}) {
    const Status status = files.begin(path(folder));
    EXPECT_EQ(status.code(), StatusCode::kIo);
    EXPECT_TRUE(status.message().starts_with(path(folder) + ": cannot be created: "))
        << status.message();
    EXPECT_TRUE(status.message().ends_with("; choose another with -o")) << status.message();
  }
  EXPECT_EQ(read(path("taken")), "x");
}

TEST_F(FileSetTest, AFolderThatTakesNoFilesIsRefusedAtTheStart) {
  FileSet files; // nobody, not even root, creates files there
  const Status status = files.begin("/proc/self");
  EXPECT_EQ(status.code(), StatusCode::kIo);
  EXPECT_TRUE(status.message().starts_with("/proc/self: ")) << status.message();
}

TEST_F(FileSetTest, AFolderInPlaceOfAFileChangesNothing) {
  std::filesystem::create_directories(path("second.txt/inside"));
  FileSet files;
  require(files.begin(folder_.string()));
  require(files.add("first.txt", "1"));
  require(files.add("second.txt", "2"));
  const Status status = files.commit();
  EXPECT_EQ(status.code(), StatusCode::kIo);
  EXPECT_TRUE(status.message().starts_with(path("second.txt") + ": is a folder"))
      << status.message();
  EXPECT_FALSE(std::filesystem::exists(path("first.txt")));
}

TEST_F(FileSetTest, ARenameThatFailsSaysWhichAndRemovesTheRest) {
  FileSet files;
  require(files.begin(folder_.string()));
  require(files.add("first.txt", "1"));
  const std::string missing = files.path_for("second.png"); // its writer never wrote it
  require(files.add("third.txt", "3"));
  const Status status = files.commit();
  EXPECT_EQ(status.code(), StatusCode::kIo);
  EXPECT_TRUE(status.message().starts_with(path("second.png") + ": ")) << status.message();
  EXPECT_EQ(names(), Names{"first.txt"});
}

TEST_F(FileSetTest, OneFileGoesIntoItsFolder) {
  FileSet files;
  std::string name;
  require(files.begin_file(path("new/F.mtx"), &name));
  EXPECT_EQ(name, "F.mtx");
  EXPECT_EQ(rows_file_name(name), "F.rows.csv");
  require(files.add(name, "F"));
  require(files.commit());
  EXPECT_EQ(read(path("new/F.mtx")), "F");
}

TEST_F(FileSetTest, DevicesFoldersAndLinksAreNotReplaced) {
  std::filesystem::create_symlink(path("elsewhere"), path("link.mtx"));
  std::string name;
  for (const std::string& target :
       {std::string("/dev/null"), folder_.string(), folder_.string() + "/", path("link.mtx")}) {
    FileSet files;
    EXPECT_EQ(files.begin_file(target, &name).code(), StatusCode::kIo) << target;
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(FileWriter, AFullDiskIsAnError) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{5} << 20}) {
    FileWriter writer;
    require(writer.open("/dev/full", "DIR/patches.csv"));
    writer.write(std::string(size, 'x'));
    const Status status = writer.close();
    EXPECT_EQ(status.code(), StatusCode::kIo);
    EXPECT_TRUE(status.message().starts_with("DIR/patches.csv: cannot be written: No space left"))
        << status.message();
  }
}

} // namespace
} // namespace hemicube::radiosity::test
