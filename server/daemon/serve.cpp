#include "daemon/parts.hpp"

#include <pthread.h>
#include <unistd.h>

#include <csignal>

#include "api/runs/run_codec.hpp"
#include "api/service/guard.hpp"
#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

void prepare_signals() {
  std::signal(SIGPIPE, SIG_IGN);  // a client that hangs up is an error of a write
  const sigset_t signals = waited_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

api::AuthMode auth_mode(const Config& config, const std::vector<http::ListenAddress>& addresses) {
  if (config.auth == "open") return api::AuthMode::Open;
  if (config.auth == "read-open") return api::AuthMode::ReadOpen;
  if (config.auth == "keys") return api::AuthMode::Keys;
  const bool loopback =
      std::ranges::all_of(addresses, [](const auto& address) { return address.is_loopback(); });
  return loopback ? api::AuthMode::Open : api::AuthMode::ReadOpen;
}

http::ServerOptions server_options(const Config& config,
                                   std::vector<http::ListenAddress> addresses) {
  http::ServerOptions options;
  options.listen = std::move(addresses);
  if (!config.tls_client_ca.empty())
    options.listen.push_back({.host = "127.0.0.1", .port = 0, .health_only = true});
  options.io_threads = static_cast<unsigned>(config.io_threads);
  // Clients beyond this number get 503 instead of no answer.
  options.max_connections = static_cast<std::size_t>(allow_connections(config.max_connections));
  options.spool_folder = config.data;
  options.tls = tls_options(config);
  options.allowed_origins = config.allow_origin;
  return options;
}

/// Counts the problem; logs the cause of an internal error once; the client gets the request's id.
/// An error with a status is the engine's, which has called handler_threw.
http::Response answer_error(api::Metrics& metrics, const Error& error, std::optional<int> status,
                            const http::Request& request) {
  metrics.count(error.code);
  if (error.code != ErrorCode::Internal || status) return api::problem(error, status, request);
  log_error("internal_error", fmt::format("request {}: {}", request.id_text(), error.message));
  return api::problem({ErrorCode::Internal,
                       "the request failed: the service log has the cause with this request id"},
                      status, request);
}

http::ServerHooks hooks(const api::Services& services, const api::Guard& guard,
                        api::Metrics& metrics) {
  http::ServerHooks hooks;
  hooks.format_error = [&services, &metrics](const Error& error, std::optional<int> status,
                                             const http::Request& request) {
    auto response = answer_error(metrics, error, status, request);
    if (!api::is_of_mtconnect(request)) return response;
    return api::mtconnect_error(services, error, std::move(response));
  };
  hooks.guard = guard;
  hooks.may_continue = [guard](const http::Request& request) {
    return guard.may_continue(request);
  };
  hooks.finished = [&metrics](const http::FinishedRequest& finished) {
    if (!finished.broken_off) metrics.count(finished);
    log_request(finished);
  };
  hooks.handler_threw = [](const http::Request& request, std::string_view what) {
    log_error("handler_threw", fmt::format("request {}: {}", request.id_text(), what));
  };
  return hooks;
}

/// Returns when the service is to end. Looks at the clock each second, to report a jump at once.
void wait_for_end(http::Server& server, bool tls, const Clock& clock) {
  const sigset_t signals = waited_signals();
  constexpr timespec kSecond{.tv_sec = 1, .tv_nsec = 0};
  for (;;) {
    const int signal = sigtimedwait(&signals, nullptr, &kSecond);
    clock.now();
    if (signal < 0) continue;
    if (signal != SIGHUP) return;
    const auto reloaded = server.reload_tls();
    if (!tls) {
      log_info("nothing_to_reload", "SIGHUP reloads certificates, and the service has none");
    } else if (reloaded) {
      log_info("certificates_reloaded", "");
    } else {
      log_error("certificates_kept", reloaded.error().message);
    }
  }
}

/// Ends the process if something outside blocks its end; all acknowledged data is on disk.
void end_in_time(const std::stop_token& stop) {
  constexpr std::chrono::seconds kLongestEnd{9};
  if (!wait_unless_stopped(stop, kLongestEnd)) return;
  log_error("stop_forced", "a thread did not end within 9 s");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the log's own thread writes it
  _exit(1);
}

void log_health(const store::Health& health) {
  const auto& [state, reason] = health;
  const bool well = state == store::HealthState::Ok || state == store::HealthState::Checking;
  const std::string detail =
      reason.empty() ? std::string(word(state)) : fmt::format("{}: {}", word(state), reason);
  well ? log_info("storage_health", detail) : log_error("storage_health", detail);
}

/// A commit has answers for many requests.
void answer_together(const std::function<void()>& answer) {
  const http::AnswerBatch batch;
  answer();
}

Result<void> serve_once(const Config& config, const std::string& port_file) {
  const auto addresses = TRY(listen_addresses(config));
  prepare_signals();
  set_up_allocation();
  report_bugs_to([](std::string_view place, std::string_view what) {
    log_error("bug", fmt::format("{}: {}", place, what));
  });

  const SystemClock machine_clock;
  ForwardClock clock(machine_clock, ForwardClock::running_time, log_warning);
  app::ApplicationOptions options = application_options(config);
  options.steady_time = [&clock] { return clock.steady(); };
  options.around_outcomes = answer_together;
  options.health_changed = log_health;
  options.job_threw = [](const Error& bug) { log_error("storage_job_threw", bug.message); };
  options.log_told = [](std::string_view event, const std::string& detail) {
    const bool is_news = event == "log_head" || event == "purged" || event.starts_with("key_");
    is_news ? log_info(event, detail) : log_warning(event, detail);
  };
  if (!config.forward_to.empty())
    options.ask_centre = [&config](std::string_view digits) { return ask_centre(config, digits); };
  http::ServerOptions listening = server_options(config, addresses);
  const auto most_clients = static_cast<std::int64_t>(listening.max_connections);
  auto opened = TRY(open_or_wait(options, clock, listening, port_file));
  if (!opened) return {};
  app::Application& app = *opened;
  // A page that cannot be read shows in the readiness, and is no reason not to start.
  const auto newest = app.newest_measurement();
  if (newest && *newest) clock.begin_after(**newest);
  for (const Error& finding : app.tables().state()->findings)
    log_error("tables_inconsistent", finding.message);
  // A damaged row does not stop a start: every write is refused, so that no value lacks its gauge.
  const auto fails = [](const Result<void>& done) {
    return !done && done.error().code != ErrorCode::StorageCorrupt;
  };
  const api::AuthMode mode = auth_mode(config, addresses);
  const auto provided = provide_admin_key(config, mode != api::AuthMode::Open, app.keys());
  if (fails(provided)) return provided.error();

  if (const auto opened_runs = app.runs().open(api::run_format()); fails(opened_runs))
    return opened_runs.error();
  api::GaugesInUse gauges(app.documents());
  if (const auto loaded = gauges.load(); fails(loaded)) return loaded.error();
  auto connecting = TRY(start_connections(config, app, clock, gauges));
  connections::Connections& outside = *connecting;
  auto forwarding = start_forwarder(config, app, tell_log);

  api::Metrics metrics;
  const auto verdicts = std::make_shared<api::VerdictCounts>(app.measurements());
  verdicts->refresh([] {});
  metrics.add([verdicts, &app, &clock, &machine_clock, &config, &outside,
               &forwarding](api::Exposition& out) {
    verdicts->write(out);
    write_application_metrics(app, out);
    write_clock_metrics(clock, machine_clock, out);
    write_storage_metrics(app, config.data, out);
    write_process_metrics(out);
    write_connection_metrics(outside.states(), clock, out);
    write_outbox_metrics(forwarding.get(), clock, out);
  });
  auto letterhead =
      TRY(certificate::read_letterhead(config.certificate_address, config.certificate_logo));
  const api::Services services{.tables = app.tables(),
                               .log = app.log(),
                               .intake = app.intake(),
                               .revisions = app.revisions(),
                               .measurements = app.measurements(),
                               .files = app.files(),
                               .documents = app.documents(),
                               .gauges = gauges,
                               .runs = app.runs(),
                               .jobs = app.jobs(),
                               .events = app.events(),
                               .metrics = metrics,
                               .verdicts = verdicts,
                               .clock = clock,
                               .readiness = [&app] { return app.readiness(); },
                               .letterhead = std::move(letterhead)};
  api::Routes of_plant(services);
  connections::add_connections_routes(of_plant, outside);
  api::add_mtconnect_routes(of_plant);
  of_plant.group("connections");
  api::Schemas schemas;
  connections::add_connection_schemas(schemas);
  auto started = TRY(http::Server::start(
      std::move(listening), api::make_routes(std::move(of_plant), schemas),
      hooks(
          services,
          api::Guard(
              app.keys(), mode, [](std::string_view what) { log_warning("proxy_suspected", what); },
              [&app] { return app.log().forked(); }),
          metrics)));
  http::Server& server = *started;
  auto control = TRY(start_control(config, services));
  auto adapter = TRY(start_shdr(config, services));
  metrics.add([&server](api::Exposition& out) { write_server_metrics(server, out); });
  if (!config.tls_client_ca.empty())
    TRY(write_port_file(health_port_file(config), server.ports().back()));
  if (!port_file.empty()) TRY(write_port_file(port_file, server.ports().front()));
  if (most_clients < config.max_connections) {
    log_warning("connections_limited", fmt::format("{} of {}: raise the hard limit of open files",
                                                   most_clients, config.max_connections));
  }
  log_info("log_head", app.log().head_text());
  for (const std::uint16_t port : server.ports())
    log_info("listening", fmt::format("port {}", port));

  wait_for_end(server, !config.tls_cert.empty(), clock);
  log_info("stopping", "");
  const Thread deadline("the end's deadline", end_in_time);
  // Cancels runs first, so that their waiting clients get an answer.
  app.jobs().call_off();
  app.runs().stop();
  control.reset();
  adapter.reset();
  server.stop();
  connecting.reset();
  forwarding.reset();
  // The application drains its queues first: the answers of its last jobs find no connection.
  opened.reset();
  started.reset();
  log_info("stopped", "");
  return {};
}

}  // namespace

Result<void> serve(const Config& config, const std::string& port_file) {
  for (;;) {
    auto served = serve_once(config, port_file);
    // Waits for a database server that is lost during the start, as for one that was unreachable.
    const bool is_away =
        !served && !config.database.empty() && served.error().code == ErrorCode::StorageUnavailable;
    if (!is_away || is_to_end_after_a_second()) return served;
  }
}

}  // namespace fitgauge::daemon
