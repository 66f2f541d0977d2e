#include "hostile/call.hpp"

#include "hostile/formulas.hpp"

#include "avi/solve.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hostile {

namespace {

Answer ask(const System& system, double tolerance) {
  Answer answer;
  try {
    avi::State<avi::dynamic> start;
    start.q = Eigen::Map<const Eigen::VectorXd>(system.q.data(), system.n);
    start.p = Eigen::Map<const Eigen::VectorXd>(system.p.data(), system.n);
    start.t = system.t;
    const auto h = [&system](const auto& q, const auto& p) { return system(q, p); };
    const auto solution = avi::solve(h, start, system.t_end, tolerance);
    answer.ok = solution.ok();
    answer.kept = solution.kept();
    answer.state_error = solution.state_error;
    answer.returned = true;
    answer.energy_error = solution.energy_error;
    answer.outcome = avi::name(solution.run.outcome);
    answer.message = solution.run.message;
    answer.report = solution.report();
    answer.steps = solution.run.steps, answer.evaluations = solution.run.evaluations;
    answer.q.assign(solution.state.q.begin(), solution.state.q.end());
    answer.p.assign(solution.state.p.begin(), solution.state.p.end());
    answer.t = solution.state.t;
  } catch (const std::exception& error) {
    answer.message = error.what();
    answer.outcome = "exception";
  }
  return answer;
}

/// Bytes to and from a pipe.
class Parcel {
 public:
  template <class T>
  void put(const T& value) {
    const char* from = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
  template <class T>
  void get(T& value) {
    if (at_ + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  template <class List>
  requires requires(List list) { list.resize(1); }
  void put(const List& list) {
    put(list.size());
    for (const auto& each : list)
      put(each);
  }
  template <class List>
  requires requires(List list) { list.resize(1); }
  void get(List& list) {
    std::size_t size = 0;
    get(size);
    list.resize(size);
    for (auto& each : list)
      get(each);
  }

  std::vector<char> bytes;

 private:
  std::size_t at_ = 0;
};

/// put() or get() of all that goes through the pipe.
void each(auto& answer, const auto& act) {
  act(answer.returned), act(answer.ok), act(answer.kept), act(answer.outcome), act(answer.message);
  act(answer.report), act(answer.state_error), act(answer.energy_error), act(answer.steps);
  act(answer.evaluations), act(answer.t), act(answer.q), act(answer.p);
}

void send(Answer answer, int to) {
  answer.message.resize(std::min<std::size_t>(answer.message.size(), 1000));
  Parcel parcel;
  each(answer, [&](const auto& entry) { parcel.put(entry); });
  const char* at = parcel.bytes.data();
  for (std::size_t left = parcel.bytes.size(); left > 0;) {
    const ssize_t sent = write(to, at, left);
    if (sent <= 0) return;
    at += sent, left -= static_cast<std::size_t>(sent);
  }
}

void bound(int resource, double most) {
  const auto whole = static_cast<rlim_t>(std::ceil(most));
  const rlimit limit{whole, whole + 1};
  setrlimit(resource, &limit);
}

}  // namespace

Answer call(const System& system, double tolerance, double seconds) {
  Answer answer;
  int ends[2];
  if (pipe(ends) != 0) return answer.message = "no pipe", answer;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    bound(RLIMIT_CPU, seconds);
    bound(RLIMIT_CORE, 0.0);
#ifndef __SANITIZE_ADDRESS__
    bound(RLIMIT_AS, 3e9);
#endif
    alarm(static_cast<unsigned>(30.0 * seconds));  // one that waits for ever takes no time of the processor
    send(ask(system, tolerance), ends[1]);
    _exit(0);
  }
  close(ends[1]);
  Parcel parcel;
  char block[4096];
  for (ssize_t got; (got = read(ends[0], block, sizeof block)) > 0;)
    parcel.bytes.insert(parcel.bytes.end(), block, block + got);
  close(ends[0]);
  int status = 0;
  rusage use{};
  wait4(child, &status, 0, &use);
  const auto in_seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  if (WIFEXITED(status) && !parcel.bytes.empty()) {
    each(answer, [&](auto& entry) { parcel.get(entry); });
  } else {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    answer.too_slow = signal == SIGXCPU || signal == SIGKILL || signal == SIGALRM;
    answer.crashed = !answer.too_slow;
    answer.outcome = answer.crashed ? "crash" : "no end";
    answer.message = answer.crashed ? "signal " + std::to_string(signal)
                                    : "stopped after " + std::to_string(static_cast<int>(seconds)) + " s";
  }
  answer.seconds = in_seconds(use.ru_utime) + in_seconds(use.ru_stime);
  return answer;
}

}  // namespace hostile
