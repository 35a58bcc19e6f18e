#include "unit/loaded_fixture.h"

#include <stdexcept>

#include "runtime/compiled/compiled_file.h"
#include "support/scratch_folder.h"
#include "unit/compiled_fixture.h"

namespace cbc::test {

LoadedCatalog load(const CompiledCatalog& catalog) {
  const ScratchFolder folder;
  folder.write("catalog.cbc", write_compiled(catalog, {}));
  const CatalogLoading loading = LoadedCatalog::load(folder / "catalog.cbc");
  if (!loading.catalog) throw std::runtime_error(loading.error);
  return *loading.catalog;
}

LoadedCatalog load_text(std::string_view yaml) { return load(compile_text(yaml)); }

}  // namespace cbc::test
