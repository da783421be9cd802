#include "daemon/commands.hpp"

int main(int argc, char** argv) { return fitgauge::daemon::run_command_line(argc, argv); }
