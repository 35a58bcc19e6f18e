#include "solve/live_page.h"

#include <chrono>
#include <random>
#include <utility>

#include <fmt/core.h>

#include "core/files/output.h"
#include "core/support/json.h"
#include "page/html_report.h"
#include "page/serve/server.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// Tells this run from those that another process serves at the same address.
std::string make_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

std::string without_line_end(std::string line) {
  line.pop_back();
  return line;
}

}  // namespace

std::unique_ptr<LivePage> LivePage::open(const CompiledCatalog& catalog, std::string_view address,
                                         std::string name, std::uint64_t index,
                                         const Coordinator& coordinator) {
  auto live = std::make_unique<LivePage>(catalog);
  const std::string begin = state_of_page(catalog, index, coordinator.now(), coordinator.state());
  live->history_.begin_part(begin);
  const std::string token = make_token();
  std::string page = stream_page(catalog, {std::move(name), begin, "", 0, "", token});
  auto [server, error] =
      serve::Server::start(*serve::read_address(address), {std::move(page), token}, live->history_);
  if (server == nullptr) {
    complain("--serve: cannot serve a page at {}: {}", quote(address), error);
    return nullptr;
  }
  live->server_ = std::move(server);
  complain("live page: {}", serve::to_url(live->server_->address()));
  return live;
}

void LivePage::add(std::string_view type, std::string_view data) {
  history_.add(type, data);
  server_->notify();
}

void LivePage::add(const EventStream::Line& line) {
  add("", line.text.substr(0, line.text.size() - 1));
  if (history_.wants_state()) {
    history_.begin_part(state_of_page(catalog_, line.record.index, line.record.time, line.state));
  }
}

void LivePage::add(const Failure& failure) {
  std::string text;
  append_failure(text, catalog_, failure);
  add("failure", text);
}

void LivePage::add_refusal(const std::string& answer) { add("refusal", without_line_end(answer)); }

void LivePage::end(const RunResult& result, const std::string& error) {
  add("end", without_line_end(json_line([&](JsonWriter& json) {
        json.write_members({{"passed", result.passed}, {"failed", result.failed}});
        if (!error.empty()) json.write("error", error);
      })));
  history_.end();
  server_->notify();
  server_->finish(std::chrono::seconds(2));
  if (!server_->was_visited()) {
    complain(
        "the stream ended before a browser opened its page; --replay LOG --html FILE makes "
        "one of a log");
  }
}

}  // namespace cbc::cli
