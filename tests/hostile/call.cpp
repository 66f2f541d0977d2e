#include "hostile/call.hpp"

#include "hostile/formulas.hpp"

#include "avi/solve.hpp"

#include <cmath>
#include <csignal>
#include <cstdlib>
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
  T get() {
    T value{};
    if (at_ + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  void put(const std::string& text) {
    put(text.size());
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  std::string get_text() {
    std::string text(get<std::size_t>(), ' ');
    for (char& letter : text)
      letter = get<char>();
    return text;
  }

  std::vector<char> bytes;

 private:
  std::size_t at_ = 0;
};

void send(const Answer& answer, int to) {
  Parcel parcel;
  parcel.put(answer.returned), parcel.put(answer.ok), parcel.put(answer.kept);
  parcel.put(answer.outcome), parcel.put(answer.message.substr(0, 1000)), parcel.put(answer.report);
  parcel.put(answer.state_error), parcel.put(answer.energy_error);
  parcel.put(answer.steps), parcel.put(answer.evaluations), parcel.put(answer.t);
  parcel.put(answer.q.size());
  for (const auto* x : {&answer.q, &answer.p})
    for (const double number : *x)
      parcel.put(number);
  const char* at = parcel.bytes.data();
  for (std::size_t left = parcel.bytes.size(); left > 0;) {
    const ssize_t sent = write(to, at, left);
    if (sent <= 0) return;
    at += sent, left -= static_cast<std::size_t>(sent);
  }
}

Answer received(Parcel& parcel) {
  Answer answer;
  answer.returned = parcel.get<bool>(), answer.ok = parcel.get<bool>(), answer.kept = parcel.get<bool>();
  answer.outcome = parcel.get_text(), answer.message = parcel.get_text();
  answer.report = parcel.get_text();
  answer.state_error = parcel.get<double>(), answer.energy_error = parcel.get<double>();
  answer.steps = parcel.get<long>(), answer.evaluations = parcel.get<long>(), answer.t = parcel.get<double>();
  const auto size = parcel.get<std::size_t>();
  for (auto* x : {&answer.q, &answer.p})
    for (std::size_t i = 0; i < size; ++i)
      x->push_back(parcel.get<double>());
  return answer;
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
    answer = received(parcel);
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
