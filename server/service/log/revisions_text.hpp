#pragma once

#include "base/json/text_arena.hpp"
#include "service/revisions/revision_feed.hpp"

namespace fitgauge::api {

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
