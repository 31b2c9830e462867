#include "Program.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Memory.h>

#include <csignal>
#include <iostream>

namespace omnimapper::program {

namespace {
volatile std::sig_atomic_t g_interrupted = 0;
void onInterrupt(int) {
  g_interrupted = 1;
}
}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  base::keepFreedMemory();
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(base::ExitCode::command_line);
  } catch (const base::Error& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << " (a defect: please report it)\n";
    return static_cast<int>(base::ExitCode::internal);
  }
}

void listenForInterrupts() {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool isInterrupted() {
  return g_interrupted != 0;
}

}  // namespace omnimapper::program
