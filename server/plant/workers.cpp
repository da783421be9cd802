#include "plant/workers.hpp"

#include "plant/lsv2/collector.hpp"

namespace fitgauge::connections {
namespace {

struct MakeWorker {
  const Plant& plant;

  std::unique_ptr<Worker> operator()(const MachineOptions& machine) const {
    return make_collector(machine, plant);
  }
  std::unique_ptr<Worker> operator()(const WebhookOptions& webhook) const {
    return std::make_unique<LogFollower>(webhook.follower, make_webhook(webhook, plant), plant);
  }
  std::unique_ptr<Worker> operator()(const MqttOptions& mqtt) const {
    return std::make_unique<LogFollower>(mqtt.follower, make_mqtt(mqtt, plant), plant);
  }
  std::unique_ptr<Worker> operator()(const SparkplugOptions& node) const {
    return std::make_unique<LogFollower>(node.follower, make_sparkplug(node, plant), plant);
  }
  std::unique_ptr<Worker> operator()(const FolderInOptions& folder) const {
    return make_folder_in(folder, plant);
  }
  std::unique_ptr<Worker> operator()(const FolderOutOptions& folder) const {
    return std::make_unique<LogFollower>(folder.follower, make_folder_out(folder, plant), plant);
  }
};

struct TestConnection {
  const Plant& plant;
  const std::stop_token& stop;

  ConnectionTest operator()(const MachineOptions& machine) const {
    return test_machine(machine, stop);
  }
  ConnectionTest operator()(const WebhookOptions& webhook) const {
    return test_webhook(webhook, plant, stop);
  }
  ConnectionTest operator()(const MqttOptions& mqtt) const {
    return test_broker(mqtt.broker, mqtt.follower.name, plant, stop);
  }
  ConnectionTest operator()(const SparkplugOptions& node) const {
    return test_broker(node.broker, node.follower.name, plant, stop);
  }
  ConnectionTest operator()(const FolderInOptions& folder) const { return test_folder_in(folder); }
  ConnectionTest operator()(const FolderOutOptions& folder) const {
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

std::unique_ptr<Worker> make_worker(const Definition& definition, const Plant& plant) {
  return std::visit(MakeWorker{plant}, definition.options);
}

ConnectionTest test_connection(const Definition& definition, const Plant& plant,
                               const std::stop_token& stop) {
  return std::visit(TestConnection{plant, stop}, definition.options);
}

}  // namespace fitgauge::connections
