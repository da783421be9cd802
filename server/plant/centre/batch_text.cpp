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

void write_answer(std::string& text, const app::LogOutbox::KeptAnswer& kept) {
  api::JsonWriter json(text);
  json.begin_object().key("answer").begin_object();
  json.member("caller", kept.request.caller)
      .member("method", kept.request.method)
      .member("path", kept.request.path)
      .member("key", kept.request.key)
      .member("request_sha256", to_hex(kept.request.body))
      .member("status", kept.answer.status)
      .member("content_type", kept.answer.content_type)
      .member("location", kept.answer.location)
      .member("body", kept.answer.body);
  if (const auto at = kept.expires_at()) json.member("expires_at", format_rfc3339(*at));
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
  for (const auto& kept : batch.answers) write_answer(text, kept);
  return text;
}

}  // namespace fitgauge::forwarder
