#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>

#include <flatbuffers/flatbuffers.h>

#include "base/text.h"
#include "catalog_generated.h"
#include "cbc/version.h"
#include "compiled/compiled_file.h"

namespace cbc {
namespace {

static_assert(std::endian::native == std::endian::little,
              "compiled catalogs are used in place, and their numbers are little-endian");

// Each struct of the solver and its like in the schema. The tests compare them field by field.
template <typename T>
struct Stored {
  using Type = T;
};
template <>
struct Stored<char> {
  using Type = std::int8_t;
};
template <>
struct Stored<CompiledTask> {
  using Type = flat::Task;
};
template <>
struct Stored<CompiledBehavior> {
  using Type = flat::Behavior;
};
template <>
struct Stored<Value> {
  using Type = flat::Value;
};
template <>
struct Stored<CompiledRequirement> {
  using Type = flat::Requirement;
};
template <>
struct Stored<Arc> {
  using Type = flat::Arc;
};
template <>
struct Stored<CompiledParameter> {
  using Type = flat::Parameter;
};

template <typename T>
constexpr bool is_stored_as_it_is =
    sizeof(T) == sizeof(typename Stored<T>::Type) &&
    alignof(T) == alignof(typename Stored<T>::Type) && std::has_unique_object_representations_v<T>;

flat::Digest to_flat(const Digest& digest) { return flat::Digest(std::span(digest.bytes)); }

Digest from_flat(const flat::Digest& digest) {
  Digest result;
  std::memcpy(result.bytes.data(), digest.bytes()->Data(), result.bytes.size());
  return result;
}

// Writing.

class Encoder {
 public:
  explicit Encoder(const CompiledCatalog& catalog) : catalog_(catalog) {}

  [[nodiscard]] std::string run(const Digest& source) {
    write_catalog(source);
    if (is_too_large_) return {};
    const std::string_view content(reinterpret_cast<const char*>(builder_.GetBufferPointer()),
                                   builder_.GetSize());
    flatbuffers::FlatBufferBuilder file(content.size() + margin);
    file.ForceVectorAlignment(content.size(), 1, alignment);
    const auto stored = file.CreateVector(builder_.GetBufferPointer(), content.size());
    const flat::Digest digest = to_flat(digest_of(content));
    flat::FinishFileBuffer(file, flat::CreateFile(file, newest_format, &digest, stored));
    return {reinterpret_cast<const char*>(file.GetBufferPointer()), file.GetSize()};
  }

 private:
  static constexpr std::size_t alignment = 16;
  static constexpr std::size_t margin = 4096;  ///< for what is around the arrays

  template <typename T>
  [[nodiscard]] auto vector(std::span<const T> items) {
    static_assert(is_stored_as_it_is<T>);
    using Type = typename Stored<T>::Type;
    is_too_large_ |= builder_.GetSize() + items.size_bytes() > largest_compiled_file - margin;
    if (is_too_large_) items = {};
    const auto* data = reinterpret_cast<const Type*>(items.data());
    if constexpr (std::is_scalar_v<Type>) {
      return builder_.CreateVector(data, items.size());
    } else {
      return builder_.CreateVectorOfStructs(data, items.size());
    }
  }

  void write_catalog(const Digest& source) {
    const CompiledCatalog& from = catalog_;
    const flat::Digest digest = to_flat(source);
    // In braces, so that the arrays are written in this order whatever the compiler.
    const std::tuple fields{builder_.CreateString(std::string(version)),
                            &digest,
                            vector(from.texts.rows().items),
                            vector(from.texts.rows().begin),
                            vector(from.task_ids),
                            vector(from.behavior_ids),
                            vector(from.behavior_packages),
                            vector(from.parameters.items),
                            vector(from.parameters.begin),
                            vector(from.allowed_values),
                            vector(from.tasks_by_name),
                            vector(from.behaviors_by_name),
                            vector(from.group_tasks),
                            vector(from.group_behaviors),
                            vector(from.topological_order),
                            vector(from.tasks),
                            vector(from.values.items),
                            vector(from.values.begin),
                            vector(from.value_tasks),
                            vector(from.words),
                            vector(from.arcs.items),
                            vector(from.arcs.begin),
                            vector(from.incoming.items),
                            vector(from.incoming.begin),
                            vector(from.task_cliques.items),
                            vector(from.task_cliques.begin),
                            vector(from.behaviors),
                            vector(from.requirements.items),
                            vector(from.requirements.begin),
                            vector(from.requirement_lines),
                            vector(from.performs.items),
                            vector(from.performs.begin),
                            vector(from.cliques.items),
                            vector(from.cliques.begin),
                            vector(from.clique_lines),
                            vector(from.masks)};
    builder_.Finish(std::apply(
        [&](const auto&... field) { return flat::CreateCatalog(builder_, field...); }, fields));
  }

  const CompiledCatalog& catalog_;
  flatbuffers::FlatBufferBuilder builder_;
  bool is_too_large_ = false;
};

// Reading.

class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] CompiledFileResult run() {
    CompiledFileResult result;
    if (const char* const fault = read(result.file.emplace())) {
      result.file.reset();
      result.error = fault;
    } else if (result.file->format > newest_format) {
      result.error = concat("its format is version ", result.file->format, ", but cbc ", version,
                            " knows none above ", newest_format, "; a newer cbc can read it");
      result.file.reset();
    }
    return result;
  }

 private:
  /// Why the file cannot be read, or null. Of a newer format only its number is read.
  [[nodiscard]] const char* read(CompiledFile& file) {
    if (!is_compiled(bytes_)) return "it is not a compiled catalog";
    if (bytes_.size() > largest_compiled_file) return "it is larger than 1 GiB";
    flatbuffers::Verifier file_verifier(data_of(bytes_), bytes_.size());
    if (!flat::VerifyFileBuffer(file_verifier)) return damaged;
    const flat::File& stored = *flat::GetFile(bytes_.data());
    file.size = bytes_.size();
    file.format = stored.format();
    if (file.format == 0) return damaged;
    if (file.format > newest_format) return nullptr;
    const std::string_view content(reinterpret_cast<const char*>(stored.content()->data()),
                                   stored.content()->size());
    file.content = from_flat(*stored.content_digest());
    if (digest_of(content) != file.content) {
      return "it is damaged: its content does not fit its digest";
    }
    if (!is_aligned(content.data(), alignof(std::max_align_t))) return damaged;
    flatbuffers::Verifier verifier(data_of(content), content.size());
    if (!verifier.VerifyBuffer<flat::Catalog>(nullptr)) return damaged;
    const flat::Catalog& catalog = *flatbuffers::GetRoot<flat::Catalog>(content.data());
    file.written_by = catalog.written_by()->str();
    file.source = from_flat(*catalog.source_digest());
    return read(catalog, file.catalog) ? nullptr : damaged;
  }

  [[nodiscard]] static bool read(const flat::Catalog& from, CompiledCatalog& to) {
    Rows<char> texts;
    if (!(take(from.texts(), texts.items) && take(from.texts_begin(), texts.begin) &&
          take(from.task_ids(), to.task_ids) && take(from.behavior_ids(), to.behavior_ids) &&
          take(from.behavior_packages(), to.behavior_packages) &&
          take(from.parameters(), to.parameters.items) &&
          take(from.parameters_begin(), to.parameters.begin) &&
          take(from.allowed_values(), to.allowed_values) &&
          take(from.tasks_by_name(), to.tasks_by_name) &&
          take(from.behaviors_by_name(), to.behaviors_by_name) &&
          take(from.group_tasks(), to.group_tasks) &&
          take(from.group_behaviors(), to.group_behaviors) &&
          take(from.topological_order(), to.topological_order) && take(from.tasks(), to.tasks) &&
          take(from.values(), to.values.items) && take(from.values_begin(), to.values.begin) &&
          take(from.value_tasks(), to.value_tasks) && take(from.words(), to.words) &&
          take(from.arcs(), to.arcs.items) && take(from.arcs_begin(), to.arcs.begin) &&
          take(from.incoming(), to.incoming.items) &&
          take(from.incoming_begin(), to.incoming.begin) &&
          take(from.task_cliques(), to.task_cliques.items) &&
          take(from.task_cliques_begin(), to.task_cliques.begin) &&
          take(from.behaviors(), to.behaviors) &&
          take(from.requirements(), to.requirements.items) &&
          take(from.requirements_begin(), to.requirements.begin) &&
          take(from.requirement_lines(), to.requirement_lines) &&
          take(from.performs(), to.performs.items) &&
          take(from.performs_begin(), to.performs.begin) &&
          take(from.cliques(), to.cliques.items) && take(from.cliques_begin(), to.cliques.begin) &&
          take(from.clique_lines(), to.clique_lines) && take(from.masks(), to.masks))) {
      return false;
    }
    const std::size_t names = to.tasks.size() + to.behaviors.size();
    if (!is_readable(texts) || texts.size() <= names) return false;
    to.texts = Texts(texts);
    to.task_names = to.texts.part(0, to.tasks.size());
    to.behavior_names = to.texts.part(to.tasks.size(), to.behaviors.size());
    to.file = to.texts[names];
    return true;
  }

  /// Whether every text lies within the characters.
  [[nodiscard]] static bool is_readable(const Rows<char>& texts) {
    return !texts.begin.empty() && std::is_sorted(texts.begin.begin(), texts.begin.end()) &&
           texts.begin.back() <= texts.items.size();
  }

  /// False if the items do not lie where they can be used: the verifier of FlatBuffers looks after
  /// bounds only, and after presence where a field is `required`, as all are up to format 1.
  template <typename T, typename Items>
  [[nodiscard]] static bool take(const flatbuffers::Vector<Items>* items, std::span<const T>& to) {
    static_assert(is_stored_as_it_is<T>);
    if (items->size() == 0) return true;
    if (!is_aligned(items->Data(), alignof(T))) return false;
    to = {reinterpret_cast<const T*>(items->Data()), items->size()};
    return true;
  }

  [[nodiscard]] static bool is_aligned(const void* address, std::size_t alignment) {
    return reinterpret_cast<std::uintptr_t>(address) % alignment == 0;
  }

  [[nodiscard]] static const std::uint8_t* data_of(std::string_view bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
  }

  static constexpr const char* damaged = "it is damaged or cut off";

  std::string_view bytes_;
};

}  // namespace

bool is_compiled(std::string_view first_bytes) {
  constexpr std::size_t place = sizeof(flatbuffers::uoffset_t);
  const std::string_view identifier = flat::FileIdentifier();
  return first_bytes.size() >= place + identifier.size() &&
         first_bytes.substr(place, identifier.size()) == identifier;
}

std::string write_compiled(const CompiledCatalog& catalog, const Digest& source) {
  return Encoder(catalog).run(source);
}

CompiledFileResult decode(std::string_view bytes) { return Decoder(bytes).run(); }

}  // namespace cbc
