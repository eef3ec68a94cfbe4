// Reads a scene file and lights it. Usage: consumer SCENE
#include "radiosity/mesh/build_patches.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/read_scene.h"

#include <cstdio>

using namespace hemicube;
using namespace hemicube::radiosity;

int main(int, char** argv) {
  Scene scene;
  ReadReport read;
  PatchSet patches;
  MeshReport mesh;
  ThreadPool pool;
  Options options;
  options.resolution = 16;
  Solution solution;
  Certificate certificate;
  for (const Status& status :
       {read_scene(argv[1], &scene, &read), build_patches(scene, &patches, &mesh), pool.init(1),
        solve_scene(scene, patches, options, pool, nullptr, &solution, &certificate)})
    if (!status.ok()) {
      std::puts(status.message().data());
      return 1;
    }
  std::printf("%016llx\n", static_cast<unsigned long long>(certificate.radiosity_hash));
  return 0;
}
