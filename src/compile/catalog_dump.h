#pragma once

#include <string>

#include "runtime/compiled/compiled_file.h"

namespace cbc {

/// What a compiled catalog holds, as JSON of the schema cbc.catalog/1, one task, behavior or
/// exclusivity list on a line:
///
///     {"schema": "cbc.catalog/1",
///      "format": 1,                         version of the file format
///      "written_by": "0.1.0",               version of cbc
///      "source": {"file": "a.yaml",         as it was named to cbc compile
///                 "digest": "…"},           XXH3-128 of its text, 32 hexadecimal digits
///      "content_digest": "…",               the same of what the file holds
///      "size": 8312,                        of the file, in bytes
///      "tasks": 21, "behaviors": 26,
///      "levels": 3,                         1 + highest level
///      "constraints": {"exclusive_pairs": 17, "requirements": 16, "task_minimums": 0,
///                      "total": 33},
///      "search_space": "1327104",           product of 1 + number of behaviors; a text
///      "variables": [                       of the situation; the first value is the initial one
///        {"variable": "TARGET", "values": ["far", "near"]},
///        {"variable": "GPS", "values": [true, false]}],      declared without values
///      "groups": [{                         in the order of their first task
///        "group": 0,                        as in "search" of cbc.solve/1
///        "levels", "constraints", "search_space": as above, for the group
///        "tasks": [{                        in catalog order
///          "task": "HOVER",
///          "level": 1,                      highest of its behaviors
///          "execution_goal": "achieve_goal",
///          "start_on_request": true,
///          "reactive_start": false,
///          "timeout": 12.5,                 seconds, or null
///          "minimum_performance": 80,       percent, or null
///          "line": 50,                      of that, in the source, or null
///          "parameters": [{"parameter": "speed", "allowed_values": ["0", "30"]}],
///          "behaviors": [                   in the order of the search: best suitability first
///            {"behavior": "HOVER_WITH_MPC", "suitability": 90}]}],       percent
///        "behaviors": [{                    in catalog order
///          "behavior": "HOVER_WITH_MPC",
///          "level": 1,                      0: requires nothing
///          "package": "…",                  empty: none given
///          "timeout": null,                 seconds; null: that of the task
///          "situation": {"TARGET": ["near"]},   the values in which it fits, of each variable that
///                                           it names
///          "requires": [{"task": "LOCALIZE", "minimum_performance": 80, "line": 12}]}],
///        "exclusivity": [{"tasks": ["HOVER", "LAND"], "line": 20}]}]}
///
/// allowed_values is a list of texts, or one text that names a type. Bytes that are no valid UTF-8
/// are replaced.
[[nodiscard]] std::string catalog_json(const CompiledFile& file);

}  // namespace cbc
