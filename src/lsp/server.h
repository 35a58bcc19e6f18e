#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/support/system.h"
#include "lsp/command_runs.h"
#include "lsp/features/features.h"
#include "lsp/inbox.h"
#include "lsp/protocol/frames.h"
#include "lsp/workspace/proofs.h"
#include "lsp/workspace/workspace.h"

namespace cbc::lsp {

/// A server of the Language Server Protocol 3.17. One thread reads messages, one proves what takes
/// a search; all else happens on the thread of run(), in the order of the messages.
class Server {
 public:
  /// Answers go to `output`, which nothing else may write to.
  explicit Server(std::FILE* output);

  /// Serves what comes from a file descriptor until the client says `exit`, or is gone. Returns the
  /// exit status: 0 if the client has asked for the shutdown before.
  [[nodiscard]] int run(int input);

 private:
  struct Proved {
    Proofs::Job job;
    CheckedCatalog catalog;
  };
  /// What the program has said to a command line.
  struct Ran {
    std::vector<std::string> words;
    Filtered said;
  };
  struct End {};
  using Item = std::variant<Json, Proved, Ran, End>;
  using Clock = std::chrono::steady_clock;
  using Handler = std::function<Json(const Json& params)>;
  using Take = std::function<void(const Json& params)>;

  void add_requests();
  void add_notifications();
  void take(const Json& message);
  void answer(const Json& id, const std::string& method, const Json& params);
  void respond(const Json& id, Json result);
  void refuse(const Json& id, int code, const std::string& message);
  void notify(const std::string& method, Json params);
  void request(const std::string& method, Json params);

  [[nodiscard]] Json initialize(const Json& params);
  void begin();
  void change_text(const Json& params);
  void take_proofs(Proved proved);
  void run_command(const Json& params);
  void show(const Ran& ran);
  /// What is to be done while no message waits. Returns whether there was anything.
  [[nodiscard]] bool work();
  void publish(const File& file);
  void prove_next();
  void renew_answers();
  void look_around();
  [[nodiscard]] bool is_client_gone() const;

  /// The file of a request, as it is now; it need not be one for cbc. Null: not known.
  [[nodiscard]] const File* file_of(const Json& params);
  /// The same with its present text only, and the names that its catalog had last, which takes no
  /// time.
  [[nodiscard]] const File* text_of_request(const Json& params);
  template <typename Use>
  [[nodiscard]] Json at_cursor(const Json& params, const File* file, Json otherwise,
                               const Use& use);

  MessageWriter output_;
  std::shared_ptr<Inbox<Item>> inbox_ =
      std::make_shared<Inbox<Item>>();  ///< threads may outlive this
  std::map<std::string, Handler> requests_;
  std::map<std::string, Take> notifications_;
  std::unique_ptr<Workspace> workspace_;  ///< null: not initialized
  std::unique_ptr<Proofs> proofs_;
  std::unique_ptr<CommandRuns> runs_;
  Client client_;
  std::set<std::string> published_;  ///< files with findings that the client shows
  Clock::time_point quiet_since_{};  ///< the last change of a text
  std::optional<int> exit_status_;
  long long client_process_ = 0;  ///< 0: not known
  Clock::time_point looked_at_disk_{};
  bool has_old_answers_ = false;  ///< a catalog is another one than what clients have asked about
  bool was_shut_down_ = false;
  int requests_made_ = 0;
};

}  // namespace cbc::lsp
