#include "daemon/parts.hpp"

#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <ctime>
#include <sstream>

#include "base/folder.hpp"
#include "daemon/log.hpp"
#include "db/store/database.hpp"

namespace fitgauge::daemon {
namespace {

namespace fs = std::filesystem;

/// 0 for a file that is not there: the write-ahead log of a closed database.
double size_of(const fs::path& file) {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(file, failure);
  return failure ? 0 : static_cast<double>(size);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

std::string text_of_kernel(const char* file) {
  const auto text = read_regular(file);
  return text ? *text : std::string();
}

/// Start of this process in seconds since 1970: the kernel counts from its own start.
double start_time() {
  // The name, in brackets, may have blanks; the start is the 20th word after it (proc(5)).
  std::string text = text_of_kernel("/proc/self/stat");
  text.erase(0, text.rfind(')') + 1);
  std::size_t at = 0;
  for (int word = 1; word < 20 && at != std::string::npos; ++word) at = text.find(' ', at + 1);
  if (at == std::string::npos || at + 1 >= text.size()) return 0;
  const double ticks = std::stod(text.substr(at + 1));
  timespec now{};
  timespec since_boot{};
  clock_gettime(CLOCK_REALTIME, &now);
  clock_gettime(CLOCK_BOOTTIME, &since_boot);
  return static_cast<double>(now.tv_sec - since_boot.tv_sec) +
         ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double open_files() {
  std::error_code failure;
  fs::directory_iterator files("/proc/self/fd", failure);
  return failure ? 0 : static_cast<double>(std::distance(begin(files), end(files)));
}

/// Pages of the address space and of memory (proc(5), statm).
std::pair<double, double> memory() {
  std::istringstream file(text_of_kernel("/proc/self/statm"));
  double all = 0;
  double resident = 0;
  file >> all >> resident;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {all * page, resident * page};
}

}  // namespace

void write_server_metrics(const http::Server& server, api::Exposition& out) {
  const http::ServerCounters counters = server.counters();
  out.gauge("fitgauge_http_connections", "Open connections").sample(counters.connections_open);
  out.counter("fitgauge_http_connections_refused_total", "Connections beyond max_connections")
      .sample(counters.connections_refused);
  out.gauge("fitgauge_http_body_bytes", "Bytes of request bodies in memory")
      .sample(counters.body_bytes_in_flight);
}

void write_application_metrics(app::Application& app, api::Exposition& out) {
  out.gauge("fitgauge_ready", "1 when the service is ready (/readyz)")
      .sample(app.readiness().findings.empty() ? 1 : 0);
  const store::Writer& writer = app.database().writer();
  const store::WriterCounters& counters = writer.counters();
  out.gauge("fitgauge_writer_queue_jobs", "Jobs that wait for the writer").sample(writer.queued());
  out.histogram("fitgauge_writer_batch_jobs", "Jobs that one commit stored")
      .sample(counters.batch_jobs);
  out.histogram("fitgauge_writer_commit_duration_seconds",
                "Time of a transaction from its begin to the disk")
      .sample(counters.commit_seconds);
  out.counter("fitgauge_writer_failures_total", "Commits and maintenance steps that failed")
      .sample(counters.failed_commits.load());
  out.gauge("fitgauge_event_readers", "Open streams of /v1/events, and outgoing connections")
      .sample(app.events().readers());
  const app::RunService::Counts runs = app.runs().counts();
  const auto sample = [&](app::RunState state) {
    out.sample(runs[static_cast<std::size_t>(state)], {{"status", word(state)}});
  };
  out.gauge("fitgauge_runs_active", "NC programs that wait or run");
  for (const auto state : {app::RunState::Queued, app::RunState::Running}) sample(state);
  out.counter("fitgauge_runs_total", "NC programs that ended, by status");
  for (auto i = static_cast<std::size_t>(app::RunState::Completed); i < app::kRunStates; ++i)
    sample(static_cast<app::RunState>(i));
}

void write_clock_metrics(const Clock& clock, const Clock& machine, api::Exposition& out) {
  const std::int64_t ahead = clock.now().nanoseconds - machine.now().nanoseconds;
  out.gauge("fitgauge_clock_ahead_seconds",
            "How far received times are ahead of the machine's clock, which was set back")
      .sample(static_cast<double>(std::max<std::int64_t>(ahead, 0)) / 1e9);
}

void write_storage_metrics(const app::Application& app, const fs::path& folder,
                           api::Exposition& out) {
  app::Database& database = app.database();
  const auto server = database.server_figures();
  out.gauge("fitgauge_reader_queue_jobs", "Jobs that wait for a reader of the database")
      .sample(database.readers().queued());
  // Every metric is listed; samples only if the engine knows them.
  out.gauge("fitgauge_database_standbys", "Standby servers of the database");
  if (server) out.sample(server->standbys);
  out.gauge("fitgauge_database_standby_behind_bytes",
            "Bytes of the write-ahead log that are not on the disk of the slowest server");
  if (server && server->standby_behind_bytes) {
    out.sample(*server->standby_behind_bytes);
  }
  struct statvfs space {};
  const bool has_files = !app.is_on_server() && statvfs(folder.c_str(), &space) == 0;
  out.gauge("fitgauge_storage_free_bytes", "Free space where the database lies");
  if (has_files)
    out.sample(static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize));
  out.gauge("fitgauge_wal_pages", "Pages in the write-ahead log after the last commit");
  if (has_files) out.sample(database.writer().counters().log_pages.load());
  out.gauge("fitgauge_database_bytes", "Size of the database");
  if (server) out.sample(server->database_bytes, {{"file", "database"}});
  if (!has_files) return;
  out.sample(size_of(folder / "fitgauge.db"), {{"file", "database"}});
  out.sample(size_of(folder / "fitgauge.db-wal"), {{"file", "wal"}});
}

void write_connection_metrics(const std::vector<connections::ConnectionState>& connections,
                              const Clock& clock, api::Exposition& out) {
  const auto each = [&](const auto& value_of) {
    for (const connections::ConnectionState& connection : connections)
      out.sample(value_of(connection), {{"connection", connection.name}});
  };
  const auto count = [&](std::uint64_t connections::ConnectionState::*member) {
    each([member](const auto& connection) { return static_cast<double>(connection.*member); });
  };
  out.gauge("fitgauge_connection_up", "1 when the last attempt succeeded");
  each([](const auto& connection) {
    return connection.last_success_at && !connection.is_failing ? 1.0 : 0.0;
  });
  out.gauge("fitgauge_connection_lag_seconds",
            "Time since the last success; outgoing: age of the next measurement; -1 before the "
            "first success");
  each([now = clock.now()](const auto& connection) {
    const auto behind = lag(connection, now);
    return behind ? static_cast<double>(*behind) / 1e9 : -1.0;
  });
  out.gauge("fitgauge_connection_behind_measurements", "Outgoing: measurements that wait");
  each([](const auto& connection) { return static_cast<double>(connection.behind); });
  out.counter("fitgauge_connection_failures_total", "Attempts that failed");
  count(&connections::ConnectionState::failures);
  out.counter("fitgauge_connection_files_total",
              "Files read because they were new, or files written");
  count(&connections::ConnectionState::files);
  out.counter("fitgauge_connection_bytes_total", "Bytes of these files");
  count(&connections::ConnectionState::bytes);
  out.counter("fitgauge_connection_measurements_total", "Measurements stored, or delivered");
  count(&connections::ConnectionState::measurements);
  out.counter("fitgauge_connection_unreadable_total", "Places in files that no reader understood");
  count(&connections::ConnectionState::unreadable);
  out.counter("fitgauge_connection_refused_total", "Measurements that the other side refused");
  count(&connections::ConnectionState::refused);
}

void write_process_metrics(api::Exposition& out) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  const auto [address_space, resident] = memory();
  static const double started = start_time();
  out.counter("process_cpu_seconds_total", "User and system time")
      .sample(seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime));
  out.gauge("process_resident_memory_bytes", "Memory in use").sample(resident);
  out.gauge("process_virtual_memory_bytes", "Size of the address space").sample(address_space);
  out.gauge("process_open_fds", "Open files").sample(open_files());
  out.gauge("process_max_fds", "Largest number of open files").sample(files.rlim_cur);
  out.gauge("process_start_time_seconds", "Start of the process, since 1970").sample(started);
  out.counter("fitgauge_log_lines_lost_total", "Log lines that were lost").sample(log_lines_lost());
}

}  // namespace fitgauge::daemon
