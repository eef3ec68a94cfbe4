#include "tests/cli/run_program.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace hemicube::test {
namespace {

constexpr unsigned kSecondsToLive = 300;

struct Pipe {
  int read_end = -1, write_end = -1;

  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    read_end = ends[0];
    write_end = ends[1];
  }
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts)
    result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& added) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (added.count(text.substr(0, text.find('='))) == 0)
      result.push_back(text);
  }
  for (const auto& [name, value] : added)
    result.push_back(name + "=" + value);
  return result;
}

int exit_code(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Reads both ends until both are closed, whichever has something to say.
void read_all(int out_end, int err_end, std::string* out, std::string* err) {
  pollfd ends[2] = {{out_end, POLLIN, 0}, {err_end, POLLIN, 0}};
  std::string* const texts[2] = {out, err};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (::poll(ends, 2, -1) < 0 && errno != EINTR)
      return;
    for (int k = 0; k < 2; ++k) {
      if (ends[k].fd < 0 || ends[k].revents == 0)
        continue;
      char bytes[65536];
      const ssize_t got = ::read(ends[k].fd, bytes, sizeof bytes);
      if (got > 0)
        texts[k]->append(bytes, static_cast<std::size_t>(got));
      else
        ends[k].fd = -1;
    }
  }
}

} // namespace

Program::Program(const std::string& path, const std::vector<std::string>& arguments,
                 const ProgramSetting& setting) {
  // All memory is allocated before the fork.
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), path);
  std::vector<std::string> variables = environment_with(setting.environment);
  const std::vector<char*> argv = pointers(words), envp = pointers(variables);
  const Pipe out, err;
  pid_ = ::fork();
  if (pid_ == 0) {
    int out_end = out.write_end;
    if (!setting.out_path.empty())
      out_end = ::open(setting.out_path.c_str(), O_WRONLY);
    ::dup2(out_end, STDOUT_FILENO);
    ::dup2(err.write_end, STDERR_FILENO);
    for (const int signal :
         {SIGINT, SIGTERM}) // a background job would inherit that it ignores them
      ::signal(signal, SIG_DFL);
    ::alarm(kSecondsToLive);
    ::execve(path.c_str(), argv.data(), envp.data());
    ::_exit(127);
  }
  ::close(out.write_end);
  ::close(err.write_end);
  out_ = out.read_end;
  err_ = err.read_end;
  if (pid_ < 0)
    throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
}

Program::~Program() {
  if (!ended_ && pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
  }
  ::close(out_);
  ::close(err_);
}

void Program::send(int signal) const {
  ::kill(pid_, signal);
}

bool Program::has_ended() {
  ended_ = ended_ || ::waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

ProgramResult Program::wait() {
  ProgramResult result;
  read_all(out_, err_, &result.out, &result.err);
  if (!ended_)
    ::waitpid(pid_, &status_, 0);
  ended_ = true;
  result.exit_code = exit_code(status_);
  return result;
}

ProgramResult run_hemicube(const std::vector<std::string>& arguments,
                           const ProgramSetting& setting) {
  return Program(hemicube_path(), arguments, setting).wait();
}

std::string hemicube_path() {
  return HC_BINARY_DIR "/hemicube";
}

} // namespace hemicube::test
