#include "core/catalog/foreign_file.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

/// A file in another language, by what its beginning has.
struct TextSign {
  std::string_view begin;  ///< what it begins with, after comments; empty: anything
  std::string_view has;    ///< a piece of text; empty: anything
  std::string_view meaning;
};

/// The first that fits counts.
constexpr TextSign text_signs[] = {
    {"<", "<BehaviorTree", "a behavior tree of BehaviorTree.CPP"},
    {"<", "BTCPP_format", "a behavior tree of BehaviorTree.CPP"},
    {"<", "<launch", "a ROS launch file in XML"},
    {"<", "<robot", "a robot description (URDF)"},
    {"<", "<scxml", "a state machine in SCXML"},
    {"<", "<sdf", "a world or model description (SDF)"},
    {"<", "<package", "the manifest of a ROS package"},
    {"<", "", "an XML file"},
    {"", "generate_launch_description", "a ROS launch file in Python"},
    {"", "import launch", "a ROS launch file in Python"},
    {"", "smach.State", "a state machine of SMACH, in Python"},
    {"", "import smach", "a state machine of SMACH, in Python"},
    {"", "import py_trees", "a behavior tree of py_trees, in Python"},
    {"", "import rclpy", "a ROS node in Python"},
    {"", "import rospy", "a ROS node in Python"},
    {"(", "(domain", "a PDDL domain"},
    {"(", "(problem", "a PDDL problem"},
};

/// As much of a text as is looked at.
constexpr std::size_t longest_beginning = std::size_t{1} << 16U;

bool is_space(char byte) { return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n'; }

/// A text from its first line on that is no comment of PDDL.
std::string_view without_comments(std::string_view text) {
  for (;;) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    if (!text.starts_with(';')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

/// Whether a key stands anywhere in the first levels of a document.
bool has_key(const Node& node, std::string_view key, int levels) {
  return levels > 0 &&
         std::any_of(node.entries.begin(), node.entries.end(), [&](const auto& entry) {
           return entry.first->text == key || has_key(*entry.second, key, levels - 1);
         });
}

bool has_kind(const Node& root, std::string_view key, Kind kind) {
  const Node* const value = root.find(key);
  return value != nullptr && value->kind == kind;
}

bool is_parameter_file(const Node& root) {
  constexpr int levels = 4;  // below names of nodes and of their namespaces
  return has_key(root, "ros__parameters", levels);
}
bool is_launch_file(const Node& root) { return has_kind(root, "launch", Kind::sequence); }
bool is_compose_file(const Node& root) { return has_kind(root, "services", Kind::mapping); }
bool is_workflow(const Node& root) {
  return has_kind(root, "jobs", Kind::mapping) && root.find("on") != nullptr;
}

/// A YAML file, by its keys.
struct DocumentSign {
  bool (*fits)(const Node& root);
  std::string_view meaning;
};

constexpr DocumentSign document_signs[] = {
    {is_parameter_file, "a ROS parameter file"},
    {is_launch_file, "a ROS launch file in YAML"},
    {is_compose_file, "a file of Docker Compose"},
    {is_workflow, "a workflow of GitHub"},
};

}  // namespace

std::string_view find_foreign_file(std::string_view text) {
  text = without_comments(utf8::without_byte_order_mark(text).substr(0, longest_beginning));
  const auto* const found =
      std::find_if(std::begin(text_signs), std::end(text_signs), [text](const TextSign& sign) {
        return text.starts_with(sign.begin) && text.find(sign.has) != std::string_view::npos;
      });
  return found == std::end(text_signs) ? std::string_view() : found->meaning;
}

std::string_view find_foreign_file(const yaml::Node& root) {
  if (root.kind == Kind::scalar) return find_foreign_file(root.text);
  const auto* const found =
      std::find_if(std::begin(document_signs), std::end(document_signs),
                   [&root](const DocumentSign& sign) { return sign.fits(root); });
  return found == std::end(document_signs) ? std::string_view() : found->meaning;
}

std::string describe_foreign_file(std::string_view expected, std::string_view found) {
  return "this is no " + std::string(expected) + "; it looks like " + std::string(found);
}

}  // namespace cbc
