#pragma once

#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace hemicube::test {

/// How a program ended and what it said.
struct ProgramResult {
  int exit_code = -1; ///< 128 + signal if a signal ended it
  std::string out, err;
};

/// What a program is started with, besides its arguments.
struct ProgramSetting {
  std::map<std::string, std::string> environment; ///< added to our own
  std::string out_path;                           ///< stdout goes here instead of into the result
};

/// A running program: started without a shell, its output read through pipes. It is killed after
/// five minutes, so that no test hangs.
class Program {
public:
  /// Throws std::runtime_error if the program cannot be started.
  Program(const std::string& path, const std::vector<std::string>& arguments,
          const ProgramSetting& setting = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void send(int signal) const;
  /// True once it has ended; does not wait.
  bool has_ended();
  ProgramResult wait();

private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

/// Runs the `hemicube` of this build to its end.
ProgramResult run_hemicube(const std::vector<std::string>& arguments,
                           const ProgramSetting& setting = {});

/// The path of the `hemicube` of this build.
std::string hemicube_path();

} // namespace hemicube::test
