#include "verify/report/open_psa.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "core/report/xml_text.h"

namespace cbc {
namespace {

using TreeNode = FaultTree::Node;

constexpr bool is_plain(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9') || byte == '_';
}

/// Part of an identifier, which may have letters, digits, '_' and single '-'. A name with anything
/// else is changed and gets its place in the catalog, from 1, to stay distinct.
std::string identifier(std::string_view name, std::uint32_t place) {
  std::string id(name);
  std::replace_if(
      id.begin(), id.end(), [](char byte) { return !is_plain(byte); }, '_');
  return id == name ? id : fmt::format("{}-{}", id, place + 1);
}

class OpenPsaWriter {
 public:
  OpenPsaWriter(const CompiledCatalog& catalog, const FaultTree& tree)
      : catalog_(catalog), tree_(tree) {}

  std::string write() {
    add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    add_comment();
    add("<opsa-mef>\n<define-fault-tree name=\"{}\">\n<label>{} in {}</label>\n",
        identifier(catalog_.name_of_task(tree_.task), catalog_.tasks[tree_.task].catalog_index),
        xml_text(catalog_.name_of_task(tree_.task)), xml_text(catalog_.file));
    for (const FaultTree::Gate& gate : tree_.gates) add_gate(gate);
    if (tree_.gates.empty()) add_impossible();
    add("</define-fault-tree>\n<model-data>\n");
    for (const BehaviorId behavior : tree_.faults) add_event(behavior);
    add("</model-data>\n</opsa-mef>\n");
    return std::move(text_);
  }

 private:
  template <typename... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
  }

  void add_comment() {
    add("<!--\nWhich faults of behaviors make the task of the first gate impossible.\n");
    if (tree_.gates.empty()) {
      add("It is impossible without any fault.\n");
    } else if (tree_.ways == 0) {
      add("No exclusivity and no minimum performance matters: a task is lost when all its "
          "behaviors "
          "are lost,\nand a behavior when it is faulty or a task that it requires is lost.\n");
    } else {
      add("Exclusivity or minimum performances matter, so the first gate has an input for each of "
          "the {} ways to\nrun the task that satisfy them.\n",
          tree_.ways);
    }
    add("The tree is exact. Basic events have no probabilities; to add one, write for example\n"
        "<float value=\"1e-4\"/> after the label of the event.\n-->\n");
  }

  void add_gate(const FaultTree::Gate& gate) {
    add("<define-gate name=\"{}\">\n<label>{}</label>\n", name_of(gate.node), label_of(gate.node));
    // Some programs demand two inputs of "and" and of "or".
    const bool is_alone = gate.inputs.size() == 1;
    const std::string_view formula = gate.needs_all ? "and" : "or";
    if (!is_alone) add("<{}>\n", formula);
    for (const TreeNode& input : gate.inputs) {
      add("<{} name=\"{}\"/>\n", input.kind == TreeNode::Kind::fault ? "basic-event" : "gate",
          name_of(input));
    }
    if (!is_alone) add("</{}>\n", formula);
    add("</define-gate>\n");
  }

  void add_impossible() {
    const TreeNode top{TreeNode::Kind::task, tree_.task};
    add("<define-gate name=\"{}\">\n<label>{}</label>\n<house-event name=\"always\"/>\n"
        "</define-gate>\n<define-house-event name=\"always\">\n<constant value=\"true\"/>\n"
        "</define-house-event>\n",
        name_of(top), label_of(top));
  }

  void add_event(BehaviorId behavior) {
    const TreeNode fault{TreeNode::Kind::fault, behavior};
    add("<define-basic-event name=\"{}\">\n<label>{}</label>\n</define-basic-event>\n",
        name_of(fault), label_of(fault));
  }

  [[nodiscard]] std::string name_of(const TreeNode& node) const {
    switch (node.kind) {
      case TreeNode::Kind::fault:
        return "fault-" + behavior_identifier(node.number);
      case TreeNode::Kind::behavior:
        return "behavior-" + behavior_identifier(node.number);
      case TreeNode::Kind::task:
        return "task-" + identifier(catalog_.name_of_task(node.number),
                                    catalog_.tasks[node.number].catalog_index);
      case TreeNode::Kind::way:
        break;
    }
    return fmt::format("way-{}", node.number + 1);
  }

  [[nodiscard]] std::string behavior_identifier(BehaviorId behavior) const {
    return identifier(catalog_.name_of_behavior(behavior),
                      catalog_.behaviors[behavior].catalog_index);
  }

  [[nodiscard]] std::string label_of(const TreeNode& node) const {
    switch (node.kind) {
      case TreeNode::Kind::fault:
        return xml_text(catalog_.name_of_behavior(node.number)) + " is faulty";
      case TreeNode::Kind::behavior:
        return xml_text(catalog_.name_of_behavior(node.number)) + " is lost";
      case TreeNode::Kind::task:
        return xml_text(catalog_.name_of_task(node.number)) + " is lost";
      case TreeNode::Kind::way:
        break;
    }
    return fmt::format("way {} is lost", node.number + 1);
  }

  const CompiledCatalog& catalog_;
  const FaultTree& tree_;
  std::string text_;
};

}  // namespace

std::string open_psa_text(const CompiledCatalog& catalog, const FaultTree& tree) {
  return OpenPsaWriter(catalog, tree).write();
}

}  // namespace cbc
