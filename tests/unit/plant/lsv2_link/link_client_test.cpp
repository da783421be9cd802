#include "plant/lsv2/link/link_client.hpp"

#include <doctest/doctest.h>

#include "plant/lsv2/link/link_server.hpp"

using namespace fitgauge;
using namespace fitgauge::control_link;

namespace {

/// Answers each request with what a table names; counts what came.
class Scripted final : public Conversation {
 public:
  explicit Scripted(const std::map<TelegramName, Telegram>& answers) : answers_(answers) {}
  std::optional<Telegram> answer(const Telegram& telegram) override {
    const auto found = answers_.find(telegram.name);
    return found == answers_.end() ? refusal(ControlError::UnknownTelegram) : found->second;
  }
  std::size_t buffer() const override { return kLargestBuffer; }

 private:
  const std::map<TelegramName, Telegram>& answers_;
};

struct Control {
  std::map<TelegramName, Telegram> answers{};
  std::unique_ptr<LinkServer> server{};

  LinkClientOptions served() {
    LinkServerOptions options;
    options.host = "127.0.0.1";
    server = LinkServer::start(std::move(options),
                               {.converse = [this] { return std::make_unique<Scripted>(answers); }})
                 .value();
    return {.address = {"127.0.0.1", server->port()}};
  }
};

}  // namespace

TEST_CASE("an address of a control has port 19000 unless it names one") {
  const auto at = [](std::string_view text) {
    const auto address = parse_control_address(text);
    return address ? to_text(*address) : "none";
  };
  CHECK(at("10.0.0.7") == "10.0.0.7:19000");
  CHECK(at("tnc.local:1") == "tnc.local:1");
  CHECK(at("[fe80::1]") == "[fe80::1]:19000");
  CHECK(at("[fe80::1]:65535") == "[fe80::1]:65535");
  for (const char* text : {"", ":1", "a:", "a:0", "a:65536", "a:1x", "a:b:c", "fe80::1", "[", "[]",
                           "[::1", "[::1]x", "[::1]:", "a b", "http://a"}) {
    CAPTURE(text);
    CHECK(at(text) == "none");
  }
}

TEST_CASE("the largest buffer that a control offers is agreed, and a refusal keeps 256 bytes") {
  Control control;
  Parameters parameters;
  SUBCASE("all is refused") {}
  SUBCASE("it offers 2048 and takes it") {
    parameters.largest_buffer = 2048;
    control.answers = {{Parameters::kName, {}},
                       {ReadParameters::kName, encode(parameters)},
                       {SystemCommand::kName, encode(Accepted{})}};
  }
  SUBCASE("it offers 4096 and refuses every one") {
    parameters.largest_buffer = 4096;
    control.answers = {{ReadParameters::kName, encode(parameters)}};
  }
  auto client = LinkClient::connect(control.served()).value();
  REQUIRE(client.agree_buffer().has_value());
  const bool agrees = control.answers.size() == 3;
  CHECK(client.buffer() == (agrees ? 2048 : 256));
  // What is too long for a telegram is not sent.
  const auto found = client.file_information("TNC:\\" + std::string(260, 'x'));
  CHECK(
      found.error().is_refusal(agrees ? ControlError::UnknownTelegram : ControlError::BadFileName));
}

TEST_CASE("a transfer ends at the caller's limit, and a false answer breaks the talk") {
  Control control;
  control.answers = {{Download::kName, encode(FileBlock{{std::string(200, 'x')}})},
                     {Accepted::kName, encode(FileBlock{{std::string(200, 'x')}})},
                     {ChangeDirectory::kName, encode(Accepted{})},
                     {ListDirectory::kName, encode(EndOfData{})},
                     {ReadFileInformation::kName, encode(Accepted{})}};
  auto client = LinkClient::connect(control.served()).value();
  CHECK(client.list("TNC:\\", 1)->empty());
  const auto endless = client.download("TNC:\\x", Transfer::Binary, 10'000);
  CHECK(endless.error().kind == LinkFailure::Kind::Unfit);
  const auto strange = client.file_information("TNC:\\x");
  CHECK(strange.error().kind == LinkFailure::Kind::Broken);
}

TEST_CASE("a stop ends the wait for a silent control") {
  // It listens but nobody answers.
  Control control;
  LinkClientOptions options = control.served();
  std::stop_source stop;
  options.stop = stop.get_token();
  auto client = LinkClient::connect(options).value();
  stop.request_stop();
  CHECK(client.login("INSPECT").error().kind == LinkFailure::Kind::Stopped);
}
