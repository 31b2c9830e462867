#include "omnimapper/graph/GraphArchive.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <sstream>

#include "omnimapper/graph/ByteIo.h"

namespace omnimapper::graph {

namespace {

// Layout, all little-endian: magic, version, session; then the variables and the factors, each as a table: number of
// sessions, (session, next index) each, number of entries, entries in the order of ids, each headed by its id.
constexpr char kMagic[] = "omnimapper.graph";
constexpr std::uint64_t kVersion = 1;
// Unused ids take memory. If a file has more of them than this in all sessions, plus this many for each record, it is
// damaged.
constexpr std::uint64_t kMaxHoles = 1'000'000, kMaxHolesPerEntry = 1000, kBytesOfId = 6;

[[noreturn]] void failDamaged(const std::string& what) {
  throw base::Error(base::ExitCode::damaged_input, "graph: " + what + ": the file is damaged; use an intact copy");
}

std::uint64_t bytesLeft(std::istream& in) {
  const auto here = in.tellg();
  const auto end = in.seekg(0, std::ios::end).tellg();
  in.seekg(here);
  if (here < 0 || end < here) failDamaged("its size is unknown");
  return static_cast<std::uint64_t>(end - here);
}

void writeEntry(std::ostream& out, const VariableRecord& record) {
  writeText(out, std::string(record.kind->kind()));
  writeUint(out, record.fixed, 1);
  for (const double number : record.value) writeDouble(out, number);
}

VariableRecord readVariable(std::istream& in, const FactorRegistry& registry) {
  VariableRecord record;
  record.kind = registry.variable(readText(in));
  record.fixed = readUint(in, 1) != 0;
  record.value.resize(record.kind->ambientSize());
  for (double& number : record.value) number = readDouble(in);
  return record;
}

void writeTags(std::ostream& out, const Tags& tags) {
  writeText(out, tags.owner);
  writeUint(out, tags.landmark.has_value(), 1);
  if (tags.landmark) writeId(out, *tags.landmark);
  writeUint(out, tags.hypothesis, 1);
  writeText(out, tags.note);
}

Tags readTags(std::istream& in) {
  Tags tags;
  tags.owner = readText(in);
  if (readUint(in, 1) != 0) tags.landmark = readId<base::LandmarkId>(in);
  tags.hypothesis = readUint(in, 1) != 0;
  tags.note = readText(in);
  return tags;
}

void writeEntry(std::ostream& out, const FactorRecord& record) {
  writeText(out, std::string(record.factor->kind()));
  // The factor is written as text, after its length, so that a reader that reads too much or too little is detected.
  std::ostringstream factor;
  record.factor->write(factor);
  writeText(out, factor.str());
  writeUint(out, record.variables.size(), 2);
  for (const base::VariableId id : record.variables) writeId(out, id);
  writeUint(out, static_cast<std::uint64_t>(record.noise.size()), 2);
  for (const double number : record.noise.matrix().reshaped()) writeDouble(out, number);
  writeUint(out, static_cast<std::uint64_t>(record.loss.kind()), 1);
  writeDouble(out, record.loss.scale());
  writeDouble(out, record.weight);
  writeTags(out, record.tags);
}

FactorRecord readFactor(std::istream& in, const FactorRegistry& registry) {
  const std::string kind = readText(in);
  std::istringstream factor_bytes(readText(in));
  std::shared_ptr<const Factor> factor = registry.readFactor(kind, factor_bytes);
  if (factor_bytes.peek() != std::istringstream::traits_type::eof())
    failDamaged("a factor of kind " + kind + " has more bytes than its reader reads");
  std::vector<base::VariableId> variables(readUint(in, 2));
  for (base::VariableId& id : variables) id = readId<base::VariableId>(in);
  const auto size = static_cast<Eigen::Index>(readUint(in, 2));
  if (size != factor->residualSize()) failDamaged("a factor of kind " + kind + " has noise of the wrong size");
  Eigen::MatrixXd noise(size, size);
  for (double& number : noise.reshaped()) number = readDouble(in);
  const auto loss_kind = static_cast<Loss::Kind>(readUint(in, 1));
  const double scale = readDouble(in);
  FactorRecord record{std::move(variables),   std::move(factor), SquareRootInformation::fromMatrix(noise),
                      Loss(loss_kind, scale), readDouble(in),    {}};
  record.tags = readTags(in);
  return record;
}

template <class Table>
void writeTable(std::ostream& out, const Table& table) {
  const std::map<std::uint16_t, std::uint32_t> next = table.nextIndices();
  writeUint(out, next.size(), 4);
  for (const auto& [session, index] : next) {
    writeUint(out, session, 2);
    writeUint(out, index, 4);
  }
  writeUint(out, table.size(), 4);
  for (const auto& [id, record] : table) {
    writeId(out, id);
    writeEntry(out, record);
  }
}

std::map<std::uint16_t, std::uint32_t> readNextIndices(std::istream& in) {
  std::map<std::uint16_t, std::uint32_t> next;
  for (std::uint64_t left = readUint(in, 4); left > 0; --left) {
    const auto session = static_cast<std::uint16_t>(readUint(in, 2));
    next[session] = static_cast<std::uint32_t>(readUint(in, 4));
  }
  return next;
}

}  // namespace

/// Rebuilds a graph with the ids it had: unused ids are skipped, so that each record gets its own index.
class GraphArchiveReader {
 public:
  GraphArchiveReader(std::istream& in, const FactorRegistry& registry) : in_(in), registry_(registry) {}

  Graph read(std::uint16_t session) {
    readTable<base::VariableId>(graph_.variables_, [&](base::VariableId) {
      VariableRecord record = readVariable(in_, registry_);
      graph_.addVariable(record.kind, record.value, record.fixed);
    });
    readTable<base::FactorId>(graph_.factors_, [&](base::FactorId) { graph_.addFactor(readFactor(in_, registry_)); });
    graph_.setSession(session);
    return std::move(graph_);
  }

 private:
  template <class IdType, class Table, class Add>
  void readTable(Table& table, const Add& add) {
    const std::map<std::uint16_t, std::uint32_t> end = readNextIndices(in_);
    std::uint64_t left = readUint(in_, 4), given = 0;
    // Each entry begins with its id, so the size of the stream limits their number.
    const std::uint64_t entries = std::min(left, bytesLeft(in_) / kBytesOfId);
    for (const auto& [session, limit] : end) given += limit;
    if (given > kMaxHoles + kMaxHolesPerEntry * entries)
      failDamaged("its sessions report " + std::to_string(given) + " used ids, too many for its records");
    std::map<std::uint16_t, std::uint32_t> next;
    for (; left > 0; --left) {
      const IdType id = readId<IdType>(in_);
      const auto limit = end.find(id.session);
      if (limit == end.end() || id.index >= limit->second || id.index < next[id.session])
        failDamaged("id " + toString(id) + " is out of order");
      for (; next[id.session] < id.index; ++next[id.session]) table.skip(id.session);
      graph_.setSession(id.session);
      add(id);
      ++next[id.session];
    }
    for (const auto& [session, limit] : end)
      for (; next[session] < limit; ++next[session]) table.skip(session);
  }

  std::istream& in_;
  const FactorRegistry& registry_;
  Graph graph_;
};

void writeGraph(const Graph& graph, std::ostream& out) {
  writeText(out, kMagic);
  writeUint(out, kVersion, 4);
  writeUint(out, graph.session(), 2);
  writeTable(out, graph.variables());
  writeTable(out, graph.factors());
}

Graph readGraph(std::istream& in, const FactorRegistry& registry) {
  if (readText(in) != kMagic) failDamaged("this is not a graph");
  const std::uint64_t version = readUint(in, 4);
  if (version > kVersion)
    throw base::Error(base::ExitCode::unreadable_input, "graph: version " + std::to_string(version) +
                                                            " is newer than this program knows (" +
                                                            std::to_string(kVersion) + "): use a newer program");
  const auto session = static_cast<std::uint16_t>(readUint(in, 2));
  try {
    return GraphArchiveReader(in, registry).read(session);
  } catch (const base::Error& error) {
    // With data from a file, an internal error means that the data is damaged, not that the program has a defect.
    if (error.code() != base::ExitCode::internal) throw;
    failDamaged(error.what());
  }
}

}  // namespace omnimapper::graph
