#include "plant/workers.hpp"

#include <fmt/format.h>

#include "plant/lsv2/collector.hpp"

namespace fitgauge::connections {
namespace {

class Lsv2Worker final : public Worker {
 public:
  Lsv2Worker(const collector::MachineOptions& machine, const Surroundings& around)
      : collector_(machine, around.app, around.clock,
                   {.failed =
                        [tell = around.tell](std::string_view name, std::string_view why) {
                          tell("connection_failing", fmt::format("{}: {}", name, why));
                        },
                    .recovered =
                        [tell = around.tell](std::string_view name) {
                          tell("connection_recovered", std::string(name));
                        },
                    .unread =
                        [tell = around.tell](std::string_view name, std::string_view path,
                                             std::string_view why) {
                          tell("log_not_understood",
                               fmt::format("{}: {}: {}; the file is kept whole", name, path, why));
                        }}) {}

  void request_stop() override { collector_.request_stop(); }
  app::ConnectionState state() const override { return collector_.state(); }

 private:
  collector::Collector collector_;
};

struct MakeWorker {
  const Surroundings& around;

  std::unique_ptr<Worker> operator()(const collector::MachineOptions& machine) const {
    return std::make_unique<Lsv2Worker>(machine, around);
  }
  std::unique_ptr<Worker> operator()(const WebhookOptions& webhook) const {
    return std::make_unique<LogFollower>(webhook.follower, make_webhook(webhook, around), around);
  }
  std::unique_ptr<Worker> operator()(const MqttOptions& mqtt) const {
    return std::make_unique<LogFollower>(mqtt.follower, make_mqtt(mqtt, around), around);
  }
  std::unique_ptr<Worker> operator()(const SparkplugOptions& node) const {
    return std::make_unique<LogFollower>(node.follower, make_sparkplug(node, around), around);
  }
  std::unique_ptr<Worker> operator()(const FolderInOptions& folder) const {
    return make_folder_in(folder, around);
  }
  std::unique_ptr<Worker> operator()(const FolderOutOptions& folder) const {
    return std::make_unique<LogFollower>(folder.follower, make_folder_out(folder, around), around);
  }
};

struct TestConnection {
  const Surroundings& around;
  const std::stop_token& stop;

  app::ConnectionTest operator()(const collector::MachineOptions& machine) const {
    return collector::test_machine(machine, stop);
  }
  app::ConnectionTest operator()(const WebhookOptions& webhook) const {
    return test_webhook(webhook, around, stop);
  }
  app::ConnectionTest operator()(const MqttOptions& mqtt) const {
    return test_broker(mqtt.broker, mqtt.follower.name, around, stop);
  }
  app::ConnectionTest operator()(const SparkplugOptions& node) const {
    return test_broker(node.broker, node.follower.name, around, stop);
  }
  app::ConnectionTest operator()(const FolderInOptions& folder) const {
    return test_folder_in(folder);
  }
  app::ConnectionTest operator()(const FolderOutOptions& folder) const {
    return test_folder_out(folder);
  }
};

}  // namespace

const FollowerOptions* follower_options(const Definition& definition) {
  return std::visit(
      [](const auto& options) -> const FollowerOptions* {
        if constexpr (requires { options.follower; }) {
          return &options.follower;
        } else {
          return nullptr;
        }
      },
      definition.options);
}

std::unique_ptr<Worker> make_worker(const Definition& definition, const Surroundings& around) {
  return std::visit(MakeWorker{around}, definition.options);
}

app::ConnectionTest test_connection(const Definition& definition, const Surroundings& around,
                                    const std::stop_token& stop) {
  return std::visit(TestConnection{around, stop}, definition.options);
}

}  // namespace fitgauge::connections
