#include "plant/centre/batch_text.hpp"

#include "base/json/json_writer.hpp"

namespace fitgauge::forwarder {
namespace {

void write_heading(std::string& text, const app::LogOutbox::Batch& batch) {
  api::JsonWriter json(text);
  json.begin_object().member("checkpoint", batch.checkpoint).member("key", batch.key);
  if (!batch.hand_overs.empty()) {
    json.key("hand_overs").begin_array();
    for (const std::string& note : batch.hand_overs) json.value(note);
    json.end_array();
  }
  json.end_object();
  text += '\n';
}

void write_answer(std::string& text, const app::LogOutbox::KeptAnswer& answer) {
  api::JsonWriter json(text);
  json.begin_object().key("answer").begin_object();
  json.member("caller", answer.caller)
      .member("method", answer.method)
      .member("path", answer.path)
      .member("key", answer.key)
      .member("request_sha256", to_hex(answer.request))
      .member("status", answer.status)
      .member("content_type", answer.content_type)
      .member("location", answer.location)
      .member("body", answer.body);
  if (answer.expires_at) json.member("expires_at", format_rfc3339(*answer.expires_at));
  json.end_object().end_object();
  text += '\n';
}

}  // namespace

std::string batch_text(const app::LogOutbox::Batch& batch) {
  std::string text;
  text.reserve(app::LogOutbox::kMostBytes);
  write_heading(text, batch);
  for (const std::string& record : batch.records) {
    text += record;
    text += '\n';
  }
  for (const auto& answer : batch.answers) write_answer(text, answer);
  return text;
}

}  // namespace fitgauge::forwarder
