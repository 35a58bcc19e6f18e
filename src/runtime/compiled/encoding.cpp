#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include <flatbuffers/flatbuffers.h>

#include "catalog_generated.h"
#include "cbc/version.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc {
namespace {

static_assert(std::endian::native == std::endian::little,
              "compiled catalogs are used in place, and their numbers are little-endian");

// The struct of the schema for each struct of the solver. The tests compare them field by field.
template <typename T>
struct Stored {
  using Type = T;
};
template <>
struct Stored<char> {
  using Type = std::int8_t;
};
template <typename Kind>
struct Stored<Id<Kind>> {
  using Type = std::uint32_t;
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

template <>
struct Stored<CompiledVariable> {
  using Type = flat::Variable;
};
template <>
struct Stored<FittingValue> {
  using Type = flat::FittingValue;
};
template <>
struct Stored<TaskRules> {
  using Type = flat::TaskRules;
};
template <>
struct Stored<Retry> {
  using Type = std::uint8_t;
};
template <>
struct Stored<CompiledLimit> {
  using Type = flat::Limit;
};

/// As an item of a vector.
template <typename T>
using StoredItem = std::conditional_t<std::is_scalar_v<typename Stored<T>::Type>,
                                      typename Stored<T>::Type, const typename Stored<T>::Type*>;

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

constexpr std::size_t content_alignment = 16;

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
    file.ForceVectorAlignment(content.size(), 1, content_alignment);
    const auto stored = file.CreateVector(builder_.GetBufferPointer(), content.size());
    const flat::Digest digest = to_flat(digest_of(content));
    // The oldest format that can say it, so that robots with an older library can read it.
    const std::uint32_t format = catalog_.has_further_keys() ? 3 : 2;
    flat::FinishFileBuffer(file, flat::CreateFile(file, format, &digest, stored));
    return {reinterpret_cast<const char*>(file.GetBufferPointer()), file.GetSize()};
  }

 private:
  static constexpr std::size_t margin = 4096;  ///< for what is around the arrays

  template <typename T>
  [[nodiscard]] flatbuffers::Offset<flatbuffers::Vector<StoredItem<T>>> vector(
      std::span<const T> items) {
    static_assert(is_stored_as_it_is<T>);
    using Type = typename Stored<T>::Type;
    // Of format 3 only what says something, so that files of format 2 stay as they were.
    constexpr std::size_t arrays_of_format_2 = 37;
    if (++arrays_ > arrays_of_format_2 && items.empty()) return {};
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
    const auto version_text = builder_.CreateString(std::string(version));
    const flat::Digest digest = to_flat(source);
    // Braces fix the order in which the arrays are written.
    const auto arrays = std::apply(
        [this](const auto&... array) { return std::tuple{vector(array)...}; }, arrays_of(catalog_));
    builder_.Finish(std::apply(
        [&](const auto&... array) {
          return flat::CreateCatalog(builder_, version_text, &digest, array...);
        },
        arrays));
  }

  const CompiledCatalog& catalog_;
  flatbuffers::FlatBufferBuilder builder_;
  std::size_t arrays_ = 0;
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
      return "it is damaged: its content does not match its digest";
    }
    if (!is_aligned(content.data(), alignof(std::max_align_t))) return damaged;
    if (!ends_with(content)) return "it is damaged: it does not end where its content does";
    flatbuffers::Verifier verifier(data_of(content), content.size());
    if (!verifier.VerifyBuffer<flat::Catalog>(nullptr)) return damaged;
    const flat::Catalog& catalog = *flatbuffers::GetRoot<flat::Catalog>(content.data());
    file.written_by = catalog.written_by()->str();
    file.source = from_flat(*catalog.source_digest());
    const auto arrays = arrays_of(file.catalog);
    constexpr std::size_t count = std::tuple_size_v<decltype(arrays)>;
    return take_all(catalog, arrays, std::make_index_sequence<count>()) ? nullptr : damaged;
  }

  /// Whether nothing but the padding up to the alignment follows the content, with which files end:
  /// the verifier of FlatBuffers ignores what follows, such as zeros that a failed copy left.
  [[nodiscard]] bool ends_with(std::string_view content) const {
    const auto end = static_cast<std::size_t>(content.data() - bytes_.data()) + content.size();
    const std::string_view rest = bytes_.substr(end);
    return (content.size() + rest.size()) % content_alignment == 0 &&
           rest.size() < content_alignment &&
           rest.find_first_not_of('\0') == std::string_view::npos;
  }

  /// The fields of the table are `written_by`, `source_digest`, and the arrays.
  template <typename Arrays, std::size_t... place>
  [[nodiscard]] static bool take_all(const flat::Catalog& from, const Arrays& to,
                                     std::index_sequence<place...> /*places*/) {
    static_assert(flat::Catalog::Traits::fields_number == 2 + sizeof...(place));
    return (take(from.get_field<2 + place>(), std::get<place>(to)) && ...);
  }

  /// False if the items are misaligned, which the verifier of FlatBuffers does not check. It checks
  /// bounds, and that the fields of format 1 are there; later ones may be missing, which means
  /// empty.
  template <typename T, typename Items>
  [[nodiscard]] static bool take(const flatbuffers::Vector<Items>* items, std::span<const T>& to) {
    static_assert(is_stored_as_it_is<T>);
    static_assert(std::is_same_v<Items, StoredItem<T>>);
    if (items == nullptr || items->size() == 0) return true;
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

  static constexpr const char* damaged = "it is damaged or truncated";

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
