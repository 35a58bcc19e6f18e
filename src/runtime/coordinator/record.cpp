#include "runtime/coordinator/record.h"

#include <array>

#include "cbc/event.h"

namespace cbc {
namespace {

constexpr auto verbs = []() {
  std::array<std::string_view, verb_forms.size()> names;
  for (std::size_t verb = 0; verb < names.size(); ++verb) names[verb] = verb_forms[verb].name;
  return names;
}();
constexpr std::array<std::string_view, 6> finish_causes{"goal_achieved",   "time_out",
                                                        "wrong_progress",  "situation_change",
                                                        "process_failure", "interrupted"};
constexpr std::array<std::string_view, 6> origins{"script", "timeout",   "reactive",
                                                  "fault",  "situation", "repair"};
constexpr std::array<std::string_view, 3> outcomes{"accepted", "rejected", "unchanged"};
constexpr std::array<std::string_view, 9> change_causes{"requested", "resumed",   "reactive",
                                                        "required",  "replaced",  "displaced",
                                                        "released",  "restarted", "undone"};
constexpr std::array<std::string_view, 4> search_statuses{"optimal", "feasible", "infeasible",
                                                          "unknown"};

}  // namespace

template <>
Words words_of<Verb>() {
  return verbs;
}
template <>
Words words_of<FinishCause>() {
  return finish_causes;
}
template <>
Words words_of<Origin>() {
  return origins;
}
template <>
Words words_of<Outcome>() {
  return outcomes;
}
template <>
Words words_of<ChangeCause>() {
  return change_causes;
}
template <>
Words words_of<SearchStatus>() {
  return search_statuses;
}

std::string_view name_of(Verb verb) { return word_of(verb); }
std::string_view name_of(FinishCause cause) { return word_of(cause); }
std::string_view name_of(Origin origin) { return word_of(origin); }
std::string_view name_of(Outcome outcome) { return word_of(outcome); }
std::string_view name_of(ChangeCause cause) { return word_of(cause); }
std::string_view name_of(SearchStatus status) { return word_of(status); }

}  // namespace cbc
