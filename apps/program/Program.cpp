#include "Program.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Memory.h>
#include <omnimapper/base/Names.h>
#include <signal.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <new>

#include "CommandLineHints.h"

namespace omnimapper::program {

namespace {
volatile std::sig_atomic_t g_interrupted = 0, g_all_is_done = 0, g_reread = 0;
// The first interrupt is seen by the next call of isInterrupted(); the second ends the program at once.
void onInterrupt(int) {
  if (g_interrupted != 0) _exit(static_cast<int>(base::ExitCode::interrupted));
  g_interrupted = 1;
  if (g_all_is_done != 0) return;
  constexpr char kAnswer[] = "\ninterrupted: finishing with what was read so far; press Ctrl-C again to end at once\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kAnswer, sizeof kAnswer - 1);
}

void answer(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);  // without SA_RESTART, so that waiting for a file or a pipe is interrupted
}
}  // namespace

void require(const std::vector<std::pair<std::string, bool>>& arguments) {
  std::string missing;
  for (const auto& [name, is_given] : arguments)
    if (!is_given) missing += (missing.empty() ? "" : ", ") + name;
  if (!missing.empty())
    throw base::Error(base::ExitCode::command_line, "this is missing: " + missing + "; --help has an example");
}

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  base::keepFreedMemory();
  app.set_version_flag("--version", app.get_name() + " " OMNIMAPPER_VERSION, "print the version and exit");
  try {
    app.parse(argc, argv);
    base::requireAddressSpace();
    return body();
  } catch (const CLI::ExtrasError&) {
    return sayUnknown(app), static_cast<int>(base::ExitCode::command_line);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    if (!saidTasks(app)) std::cerr << app.get_name() << ": " << base::printableLines(error.what()) << "; see --help\n";
    return static_cast<int>(base::ExitCode::command_line);
  } catch (const base::Error& error) {
    std::cerr << app.get_name() << ": " << base::printableLines(error.what()) << "\n";
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    std::cerr << app.get_name() << ": out of memory; files written before are kept\n";
    return static_cast<int>(base::ExitCode::out_of_memory);
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << base::printableLines(error.what()) << " (a defect: please report it)\n";
    return static_cast<int>(base::ExitCode::internal);
  }
}

void listenForInterrupts() {
  answer(SIGINT, onInterrupt);
  answer(SIGTERM, onInterrupt);
  answer(SIGXFSZ, SIG_IGN);
}

void listenForRereads() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_reread = 1; };
  action.sa_flags = SA_RESTART;  // sensors need not notice
  sigaction(SIGUSR1, &action, nullptr);
}

bool takeReread() {
  if (g_reread == 0) return false;
  g_reread = 0;
  return true;
}

bool isInterrupted() {
  return g_interrupted != 0;
}

void nothingIsLeftToDo() {
  g_all_is_done = 1;
}

}  // namespace omnimapper::program
