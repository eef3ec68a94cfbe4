// Rows of form factors by other programs: hemicubes per second on one thread, and how far the rows
// are from hemicube's. Usage: peers OUTPUT_FOLDER [scene-filter] [resolution]
#include "bench/bench_scenes.h"
#include "bench/machine.h"
#include "bench/peers/hemicube_peer.h"
#include "bench/peers/peer.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

using namespace hemicube;
using namespace hemicube::bench;
using radiosity::PatchSet;

namespace {

constexpr std::uint32_t kResolutions[] = {64, 256, 1024};
constexpr std::uint32_t kThreadsResolution = 256;
constexpr int kRepetitions = 5;
constexpr double kSlowestSeconds = 0.4; ///< of a repetition of the slowest program
constexpr double kLeastSeconds = 0.1;   ///< a faster program goes over its receivers again
constexpr double kLeastReceivers = 12, kMostReceivers = 4096;
constexpr double kFarSlower = 20; ///< times as slow as this program: fewer receivers

using Receivers = std::vector<std::uint32_t>;

/// A program, and what was measured of it.
struct Entry {
  std::unique_ptr<Peer> peer;
  Receivers receivers; ///< as often as it takes to measure the time
  std::vector<double> seconds;
  std::size_t distinct = 0; ///< receivers that are timed, each as often as it takes
  std::uint64_t hash = 0;   ///< of `rows`
  DenseRows rows;

  double hemicubes_per_second() {
    std::sort(seconds.begin(), seconds.end());
    return static_cast<double>(receivers.size()) / seconds[seconds.size() / 2];
  }
};

/// How far rows are from those of hemicube.
struct Difference {
  double rms = 0;    ///< over all entries
  double max_l1 = 0; ///< the largest sum over a row
};

Difference difference(const DenseRows& a, const DenseRows& b, std::size_t row_size) {
  Difference found;
  for (std::size_t row = 0; row < a.size(); row += row_size) {
    double l1 = 0;
    for (std::size_t k = row; k < row + row_size; ++k) {
      l1 += std::fabs(a[k] - b[k]);
      found.rms += (a[k] - b[k]) * (a[k] - b[k]);
    }
    found.max_l1 = std::max(found.max_l1, l1);
  }
  found.rms = std::sqrt(found.rms / static_cast<double>(a.size()));
  return found;
}

double time_rows(Peer& peer, const Receivers& receivers, DenseRows* dense, std::uint64_t* hash) {
  const auto start = std::chrono::steady_clock::now();
  peer.rows(receivers, dense, hash);
  const std::chrono::duration<double> call = std::chrono::steady_clock::now() - start;
  return peer.seconds() < 0 ? call.count() : peer.seconds();
}

/// Seconds a row, from a short run after a shorter one.
double calibrate(Peer& peer, const PatchSet& patches) {
  const Receivers few = scattered(patches, 4);
  std::uint64_t hash = 0;
  time_rows(peer, few, nullptr, &hash);
  return time_rows(peer, few, nullptr, &hash) / static_cast<double>(few.size());
}

Receivers repeated(const Receivers& receivers, double count) {
  Receivers all = receivers;
  while (static_cast<double>(all.size()) < std::min(count, 1e5))
    all.insert(all.end(), receivers.begin(), receivers.end());
  return all;
}

std::vector<Entry> all_programs() {
  std::vector<Entry> entries;
  const auto add = [&](std::unique_ptr<Peer> peer, const char* without) {
    if (peer == nullptr) {
      std::fprintf(stderr, "peers: %s\n", without);
      return;
    }
    Entry entry;
    entry.peer = std::move(peer);
    entries.push_back(std::move(entry));
  };
  add(make_hemicube_peer(1), "");
  add(make_embree_peer(false), "built without Embree (libembree-dev): left out");
  if (entries.size() > 1)
    add(make_embree_peer(true), "");
  add(make_llvmpipe_peer(), "no llvmpipe (libegl-dev libgl-dev libgl1-mesa-dri): left out");
  add(make_floor_peer(), "");
  return entries;
}

void print_line(std::ofstream& csv, const char* line) {
  csv << line;
  csv.flush();
}

/// Times all programs on a scene at a resolution. entries[0] is hemicube.
void measure(const BenchScene& scene, const PatchSet& patches, std::uint32_t resolution,
             std::vector<Entry>& entries, std::ofstream& csv) {
  std::vector<double> row_seconds;
  for (Entry& entry : entries) {
    entry.peer->prepare(patches, resolution);
    row_seconds.push_back(calibrate(*entry.peer, patches));
  }
  const auto receivers_for = [&](double seconds) {
    return scattered(patches, static_cast<std::uint32_t>(std::clamp(
                                  kSlowestSeconds / seconds, kLeastReceivers, kMostReceivers)));
  };
  // Rows are compared for what the slowest has time for. All are timed on the same receivers but
  // those that are far slower than this program: what a receiver costs varies, and few mislead.
  const Receivers compared =
      receivers_for(*std::max_element(row_seconds.begin(), row_seconds.end()));
  double shared = 0;
  for (const double seconds : row_seconds)
    if (seconds < kFarSlower * row_seconds[0])
      shared = std::max(shared, seconds);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    Entry& entry = entries[k];
    entry.seconds.clear();
    time_rows(*entry.peer, compared, &entry.rows, &entry.hash);
    const Receivers timed = row_seconds[k] <= shared ? receivers_for(shared) : compared;
    entry.distinct = timed.size();
    entry.receivers = repeated(timed, kLeastSeconds / row_seconds[k]);
  }
  for (int repetition = 0; repetition < kRepetitions; ++repetition)
    for (Entry& entry : entries) {
      std::uint64_t hash = 0;
      entry.seconds.push_back(time_rows(*entry.peer, entry.receivers, nullptr, &hash));
    }
  const double own = entries[0].hemicubes_per_second();
  for (Entry& entry : entries) {
    // The floor repeats the row of one receiver: there is nothing to compare.
    char differences[64] = ",";
    if (entry.peer->name() != "floor") {
      const Difference d = difference(entry.rows, entries[0].rows, patches.patch_count());
      std::snprintf(differences, sizeof differences, "%.2e,%.2e", d.rms, d.max_l1);
    }
    const double rate = entry.hemicubes_per_second();
    char line[300];
    std::snprintf(line, sizeof line, "%s,%u,%u,%s,%zu,%.1f,%.2f,%s,%016" PRIx64 "\n", scene.name,
                  patches.patch_count(), resolution, entry.peer->name().c_str(), entry.distinct,
                  rate, own / rate, differences, entry.hash);
    print_line(csv, line);
    std::printf("%-11s %7u %5u  %-14s %5zu %10.1f/s %8.2fx  %s\n", scene.name,
                patches.patch_count(), resolution, entry.peer->name().c_str(), entry.distinct, rate,
                own / rate, differences);
    std::fflush(stdout);
  }
}

/// Times hemicube on one thread and on two. @return false if their hashes differ
bool measure_threads(const BenchScene& scene, const PatchSet& patches, std::ofstream& csv) {
  std::vector<Entry> entries(2);
  entries[0].peer = make_hemicube_peer(1);
  entries[1].peer = make_hemicube_peer(2);
  for (Entry& entry : entries)
    entry.peer->prepare(patches, kThreadsResolution);
  const double row_seconds = calibrate(*entries[0].peer, patches);
  const Receivers once =
      scattered(patches, static_cast<std::uint32_t>(
                             std::min(std::ceil(kSlowestSeconds / row_seconds), kMostReceivers)));
  const Receivers receivers = repeated(once, kSlowestSeconds / row_seconds);
  for (int repetition = 0; repetition < kRepetitions; ++repetition)
    for (Entry& entry : entries) {
      entry.receivers = receivers;
      entry.seconds.push_back(time_rows(*entry.peer, receivers, nullptr, &entry.hash));
    }
  const double one = entries[0].hemicubes_per_second(), two = entries[1].hemicubes_per_second();
  char line[300];
  std::snprintf(line, sizeof line, "%s,%u,%u,%zu,%.1f,%.1f,%.2f,%016" PRIx64 "\n", scene.name,
                patches.patch_count(), kThreadsResolution, receivers.size(), one, two, two / one,
                entries[0].hash);
  print_line(csv, line);
  std::printf("%-11s %7u %5u  two threads    %5zu %10.1f/s, one %.1f/s: %.2fx\n", scene.name,
              patches.patch_count(), kThreadsResolution, receivers.size(), two, one, two / one);
  std::fflush(stdout);
  if (entries[0].hash == entries[1].hash)
    return true;
  std::fprintf(stderr, "peers: %s: one and two threads differ\n", scene.name);
  return false;
}

int run(const std::filesystem::path& output, const std::string& filter, std::uint32_t only) {
  const std::filesystem::path folder = output / (cpu_name() + "_" + raster::best_kernels().name);
  std::filesystem::create_directories(folder);
  std::ofstream peers_csv(folder / "peers.csv"), threads_csv(folder / "threads.csv");
  peers_csv << "scene,patches,resolution,program,receivers,hemicubes_per_second,hemicube_ratio,"
               "rms_difference,max_l1_difference,hash\n";
  threads_csv << "scene,patches,resolution,receivers,one_thread,two_threads,speed_up,hash\n";
  std::vector<Entry> entries = all_programs();
  bool same = true;
  for (const BenchScene& scene : kBenchScenes) {
    if (std::string(scene.name).find(filter) == std::string::npos)
      continue;
    const PatchSet patches = scene.build();
    for (const std::uint32_t resolution : kResolutions)
      if (only == 0 || only == resolution)
        measure(scene, patches, resolution, entries, peers_csv);
    if (only == 0 || only == kThreadsResolution)
      same = measure_threads(scene, patches, threads_csv) && same;
  }
  std::printf("written to %s\n", folder.c_str());
  return same ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: peers OUTPUT_FOLDER [scene-filter] [resolution]\n");
    return 2;
  }
  try {
    return run(argv[1], argc > 2 ? argv[2] : "",
               argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[3])) : 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peers: %s\n", error.what());
    return 1;
  }
}
