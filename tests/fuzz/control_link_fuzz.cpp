// Bytes as what a client, or a control, sends: each telegram is the same however it is cut on its
// way, and what is read of it is written as it was.

#include "plant/lsv2/link/messages.hpp"
#include "plant/lsv2/link/payload.hpp"
#include "target.hpp"

using namespace fitgauge::control_link;

namespace {

std::vector<Telegram> read_all(std::string_view bytes, std::size_t step) {
  TelegramReader reader;
  std::vector<Telegram> telegrams;
  while (!bytes.empty()) {
    reader.feed(bytes.substr(0, step));
    bytes.remove_prefix(bytes.size() < step ? bytes.size() : step);
    for (;;) {
      const auto next = reader.next();
      if (!next) return telegrams;
      if (!*next) break;
      telegrams.push_back(**next);
    }
  }
  return telegrams;
}

template <class... Messages>
void check_as(const Telegram& telegram) {
  const auto check = [&telegram]<class Message>(Message*) {
    if (const auto message = decode<Message>(telegram)) require(encode(*message) == telegram);
  };
  (check(static_cast<Messages*>(nullptr)), ...);
}

}  // namespace

void take(std::string_view bytes) {
  const std::vector<Telegram> telegrams = read_all(bytes, bytes.size() + 1);
  require(telegrams == read_all(bytes, 1));
  for (const Telegram& telegram : telegrams) {
    require(framed(telegram).size() < kSmallestBuffer);
    if (const auto request = read_request(telegram)) {
      std::visit([&](const auto& message) { require(encode(message) == telegram); }, *request);
    }
    check_as<Refused, Versions, Version, Parameters, DirectoryInformation, FileInformation,
             DirectoryEntry, Memory, MachineParameter, DataValue, Axes, State, ProgramStack,
             Overrides, Fault, SpindleTool>(telegram);
  }
}
