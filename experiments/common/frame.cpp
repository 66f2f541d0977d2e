#include "common/frame.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <unistd.h>

namespace experiment {
namespace {

/// Blocks SIGINT, SIGTERM and SIGHUP during its lifetime, so that no temporary file is left behind.
class Uninterrupted {
 public:
  Uninterrupted() {
    sigset_t interrupts;
    sigemptyset(&interrupts);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
      sigaddset(&interrupts, signal);
    sigprocmask(SIG_BLOCK, &interrupts, &before_);
  }
  ~Uninterrupted() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  sigset_t before_{};
};

/// Creates the folder and checks, before any work is done, that 4096 bytes can be written in it; on a full
/// disk, files can still be created.
void require_writable(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const Uninterrupted here;
  const auto probe = folder / fmt::format(".probe.{}", ::getpid());
  std::ofstream file(probe);
  file << std::string(4096, ' ') << std::flush;
  const bool writable = !error && file.good();
  std::filesystem::remove(probe, error);
  if (!writable)
    throw std::invalid_argument(fmt::format(
        "Output folder '{}' cannot be written; name one that can with --output DIR.", folder.string()));
}

/// An error message if there is no folder of that name; otherwise empty.
std::string missing(const std::string& folder) {
  std::error_code unreachable;
  if (std::filesystem::is_directory(folder, unreachable)) return {};
  return fmt::format("folder {} does not exist", folder);
}

void add(CLI::App& app, const Option& option) {
  const auto& [flag, value, description] = option;
  if (auto* const* on = std::get_if<bool*>(&value)) app.add_flag(flag, **on, description);
  if (auto* const* text = std::get_if<std::string*>(&value)) app.add_option(flag, **text, description);
  if (auto* const* folder = std::get_if<std::filesystem::path*>(&value))
    app.add_option(flag, **folder, description)->option_text("DIR")->capture_default_str()->check(missing);
}

int refuse(std::string_view name, std::string_view sentence) {
  fmt::print(stderr, "{}: {}\n", name, sentence);
  return 2;
}

}  // namespace

void Frame::write(const Table& table, std::string_view curve) const {
  const Uninterrupted here;
  table.write(output / (curve.empty() ? name + ".tsv" : fmt::format("{}_{}.tsv", name, curve)));
}

void Frame::write_tables() const {
  for (const bool last : {false, true})
    for (const auto& [curve, table] : tables)
      if (curve.empty() == last) write(table, curve);
}

void Frame::progress(std::string_view label, double done, double of) const {
  line_open = ::isatty(STDERR_FILENO);
  if (!line_open) return;
  fmt::print(stderr, "\r{}: {:<40} {:3.0f} %", name, label, 100.0 * done / of);
  std::fflush(stderr);
}

int run(int argc, char** argv, const std::string& shows, const std::vector<Option>& options,
        const std::function<void(Frame&)>& body) {
  const std::string name = std::filesystem::path(argv[0]).filename();
  Frame frame{.name = name, .output = "build/data"};
  CLI::App app(shows, name);
  const auto* output = app.add_option("--output", frame.output,
                                      "Folder of the data files, made where it is missing: build/data, of a "
                                      "shorter or longer run build/quick, build/long ...")
                           ->option_text("DIR");
  app.add_flag("--quick", frame.quick, "A shortened run for tests: same columns, fewer or shorter rows");
  for (const Option& option : options)
    add(app, option);
  // a file that grows too large becomes a write error instead of ending the program
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    app.parse(argc, argv);
    for (const char* mode : {"full", "extremes", "long", "quick"})  // keeps these runs apart from the data
      if (const auto* flag = app.get_option_no_throw(std::string("--") + mode);
          flag && flag->count() > 0 && output->count() == 0)
        frame.output = std::filesystem::path("build") / mode;
    require_writable(frame.output);
    body(frame);
    frame.write_tables();
    if (frame.line_open) {
      frame.progress("done", 1.0);
      fmt::print(stderr, "\n");
    }
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(name, fmt::format("{}. Run with --help for the options.", error.what()));
  } catch (const std::invalid_argument& error) {
    return refuse(name, error.what());
  } catch (const FileError& error) {
    return refuse(name, error.what());
  } catch (const std::exception& error) {
    refuse(name, error.what());
    return 1;
  }
  return 0;
}

}  // namespace experiment
