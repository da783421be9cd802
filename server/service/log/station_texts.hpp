#pragma once

#include "base/json/text_arena.hpp"
#include "service/log/log_forwarding.hpp"
#include "service/revisions/revisions.hpp"

namespace fitgauge::api {

/// A batch with the texts that its rows view, if they are not in the body.
struct ReadBatch {
  app::ForwardedBatch batch;
  TextArena texts;
};

/// The body of `PUT /v1/log/{origin}/{from}`.
std::string batch_text(const app::LogOutbox::Batch& batch);
/// Reads such a body, which must outlive the batch.
/// @errors LogRecordInvalid and those of JSON, each with the line; RequestInvalid.
Result<std::unique_ptr<ReadBatch>> read_batch(std::string_view origin, std::int64_t from,
                                              std::string_view body);

/// A page and the texts its measurements have views of.
struct ReadRevisions {
  app::RevisionPage page;
  TextArena texts;
};

/// The answer of `GET /v1/log/revisions`.
std::string revisions_text(const app::RevisionPage& page);
/// Reads it. Unknown kinds are left out.
/// @errors those of JSON; RequestInvalid, LogRecordInvalid.
Result<std::unique_ptr<ReadRevisions>> read_revisions(std::string_view body);

}  // namespace fitgauge::api
