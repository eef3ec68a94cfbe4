#include "tests/support/scene_files.h"

#include <algorithm>
#include <random>

namespace hemicube::radiosity::test {
namespace {

class SceneMutation : public SceneFiles {};

/// Bytes of a small text replaced, removed, repeated, or exchanged for nasty words.
std::string mutated(std::string text, std::mt19937& random) {
  static const std::vector<std::string> kWords = {
      "nan",  "inf", "1e999", "-1",         "0",    "99999999999999999999",
      "\\\n", "\r",  "\n",    "#",          "/",    "\"",
      "{",    "}",   "[",     "]",          ",",    ":",
      "f ",   "v ",  " ",     "usemtl x\n", "g\n",  "1",
      "2.5",  "e",   "\xff",  "null",       "true", "Kd 0.5\n"};
  for (auto count = 1 + random() % 3; count > 0 && !text.empty(); --count) {
    const std::size_t at = random() % text.size();
    const std::size_t length = random() % 8;
    switch (random() % 5) {
    case 0:
      text[at] = static_cast<char>(random() & 0xff);
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(random() % text.size(), 4 * length));
      break;
    case 3:
      text.insert(at, kWords[random() % kWords.size()]);
      break;
    case 4:
      text.resize(std::max(at, text.size() / 2));
      break;
    }
  }
  return text;
}

TEST_F(SceneMutation, MutatedFilesAreRefusedOrSound) {
  const std::string files[] = {
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-3 +1 \\\n1.5\ng a b\nusemtl red\nf 1 2 3\n"
      "f -1/1 -2//2 -3/3/3 1\nusemtl lamp\nvn 0 0 1\nf 1 2 3 4 # x\n",
      "newmtl red\nKd 0.5 0.25 1\nKs 1 1 1\nnewmtl lamp\nKe 10\nKd 0.1\nmap_Kd x.png\n",
      "{\"format\": \"hemicube-scene\", \"version\": 1, \"units\": \"cm\",\n\"bands\": [\"r\", "
      "\"g\", "
      "\"b\"],\n\"materials\": {\"red\": {\"reflectance\": [0.5, 0.25, 1], \"two_sided\": true}},\n"
      "\"meshes\": [{\"file\": \"m.obj\", \"max_edge\": 0.5, \"transform\": "
      "[1,0,0,0, 0,-1,0,0, 0,0,1,0.5, 0,0,0,1]},\n{\"file\": \"m.obj\", \"material\": \"red\"}],\n"
      "\"space_exitance\": 1.5,\n\"camera\": {\"position\": [0,0,5], \"target\": [0,0,0], "
      "\"width\": 64}}\n"};
  const std::string names[] = {"m.obj", "m.mtl", "m.json"};
  for (int i = 0; i < 3; ++i)
    write(names[i], files[i]);
  expect_read("m.json");
  expect_read("m.obj");

  std::mt19937 random(20240229);
  int sound = 0, refused = 0;
  for (int round = 0; round < 2100; ++round) {
    const int which = round % 3;
    const std::string text = mutated(files[which], random);
    write(names[which], text);
    for (const char* top : {"m.json", "m.obj"}) {
      SCOPED_TRACE(text);
      const Status status = read(top);
      if (status.ok()) {
        ++sound;
        expect_scene_is_sound(scene_);
      } else {
        ++refused;
        EXPECT_EQ(status.code(), StatusCode::kBadScene);
        EXPECT_TRUE(status.message().starts_with(folder_.string())) << status.message();
      }
      if (HasFailure())
        return;
    }
    write(names[which], files[which]);
  }
  EXPECT_GT(sound, 300); // else the mutations only ever test the first check
  EXPECT_GT(refused, 300);
}

} // namespace
} // namespace hemicube::radiosity::test
