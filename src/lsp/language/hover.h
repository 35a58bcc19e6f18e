#pragma once

#include <string>
#include <string_view>

#include "core/catalog/catalog.h"
#include "core/files/recognition.h"
#include "lsp/language/context.h"

namespace cbc::lsp {

/// What there is to say of the thing at the cursor: a task, behavior or variable of the catalog, a
/// parameter, a key or word of the language, a rule. Markdown; empty if there is nothing.
[[nodiscard]] std::string describe(const Context& context, cli::FileKind kind,
                                   const Catalog* catalog);

/// The text of a rule of lint as Markdown; empty if there is none of this name.
[[nodiscard]] std::string describe_rule(std::string_view name);

}  // namespace cbc::lsp
