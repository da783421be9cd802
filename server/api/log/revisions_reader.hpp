#pragma once

#include <memory>
#include <string_view>

#include "api/wire/text_arena.hpp"
#include "app/revisions/revision.hpp"
#include "base/result.hpp"

namespace fitgauge::api {

/// A page and the texts its measurements have views of.
struct ReadRevisions {
  app::RevisionPage page;
  TextArena texts;
};

/// Reads what `GET /v1/log/revisions` answers. A kind that is not known here is left out.
/// @errors those of JSON; RequestInvalid, LogRecordInvalid.
Result<std::unique_ptr<ReadRevisions>> read_revisions(std::string_view body);

}  // namespace fitgauge::api
