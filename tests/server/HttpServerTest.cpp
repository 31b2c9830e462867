#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "Client.h"
#include "omnimapper/server/HttpServer.h"

namespace omnimapper::server::http_server_test {
namespace {

/// A server in a thread of its own, which answers with method, path and body.
class Running {
 public:
  explicit Running(const HttpLimits& limits = {}, HttpServer::Condition is_urgent = {})
      : server_(
            "127.0.0.1", 0, limits, [this](const HttpRequest& request) { return answer(request); },
            std::move(is_urgent)),
        thread_([this] { server_.run([this] { return stopped_.load(); }, [this] { sendWaiting(); }); }) {}
  ~Running() {
    release();
    stopped_ = true;
    thread_.join();
  }
  std::uint16_t port() const { return server_.port(); }
  int answered() const { return answered_; }
  void sendEvent(const std::string& event) {
    const std::lock_guard lock(mutex_);
    waiting_ = event;
  }
  /// Lets answers that take long be made.
  void release() {
    const std::lock_guard lock(mutex_);
    is_released_ = true;
    released_.notify_all();
  }
  /// The whole answer to these bytes, after which the connection must be closed.
  std::string talk(const std::string& bytes) {
    Client client(port());
    client.send(bytes);
    return client.readAll();
  }

 private:
  HttpResponse answer(const HttpRequest& request) {
    ++answered_;
    HttpResponse response{200, "text/plain", request.method + " " + request.path + " " + request.body};
    response.is_event_stream = request.path == "/events";
    if (response.is_event_stream) response.body = "data: first\n\n";
    if (request.path == "/slow") response.later = [this] { return slowAnswer(); };
    if (request.path == "/file") response.file = request.values.at("name");
    return response;
  }
  /// Waits until release().
  HttpResponse slowAnswer() {
    std::unique_lock lock(mutex_);
    released_.wait(lock, [this] { return is_released_; });
    return {200, "text/plain", "at last"};
  }
  void sendWaiting() {
    const std::lock_guard lock(mutex_);
    if (!waiting_.empty()) server_.send(waiting_);
    waiting_.clear();
  }

  std::atomic<bool> stopped_ = false;
  std::atomic<int> answered_ = 0;
  std::mutex mutex_;
  std::condition_variable released_;
  bool is_released_ = false;  // guarded by mutex_, as is waiting_
  std::string waiting_;
  HttpServer server_;
  std::thread thread_;
};

std::string statusOf(const std::string& answer) {
  return answer.substr(0, 12);
}

constexpr char kClose[] = "Host: a\r\nConnection: close\r\n\r\n";

TEST(HttpServer, AnAnswerThatTakesLongDelaysNoOther) {
  HttpLimits limits;
  limits.waiting_answers = 2;
  Running server(limits);
  Client first(server.port()), second(server.port());
  first.send("GET /slow HTTP/1.1\r\nHost: a\r\n\r\n");
  EXPECT_EQ(statusOf(server.talk(std::string("GET /quick HTTP/1.1\r\n") + kClose)), "HTTP/1.1 200");
  second.send(std::string("GET /slow HTTP/1.1\r\n") + kClose);
  EXPECT_EQ(statusOf(server.talk(std::string("GET /quick HTTP/1.1\r\n") + kClose)), "HTTP/1.1 200");
  EXPECT_EQ(statusOf(server.talk(std::string("GET /slow HTTP/1.1\r\n") + kClose)), "HTTP/1.1 503") << "two wait";
  server.release();
  EXPECT_NE(first.readTo("at last").find("at last"), std::string::npos);
  EXPECT_NE(second.readAll().find("at last"), std::string::npos);
  first.send("GET /quick HTTP/1.1\r\nHost: a\r\n\r\n");
  EXPECT_NE(first.readTo("GET /quick").find("GET /quick"), std::string::npos) << "the connection is kept";
}

TEST(HttpServer, ARequestIsAnsweredAndTheConnectionIsKept) {
  Running server;
  Client client(server.port());
  for (const char* path : {"/one", "/two"}) {
    client.send(std::string("GET ") + path + " HTTP/1.1\r\nHost: a\r\n\r\n");
    const std::string answer = client.readTo(std::string("GET ") + path + " ");
    EXPECT_EQ(statusOf(answer), "HTTP/1.1 200") << answer;
  }
  client.send(std::string("HEAD /three HTTP/1.1\r\n") + kClose);
  const std::string answer = client.readAll();
  EXPECT_EQ(statusOf(answer), "HTTP/1.1 200");
  EXPECT_NE(answer.find("Content-Length: 12\r\n"), std::string::npos) << answer;
  EXPECT_EQ(answer.substr(answer.size() - 4), "\r\n\r\n") << "HEAD has no body";
}

TEST(HttpServer, TooLargeCompressedOrDamagedRequestsNeverReachTheHandler) {
  HttpLimits limits;
  limits.header_bytes = 1000;
  limits.body_bytes = 100;
  Running server(limits);
  const std::string begin = "POST / HTTP/1.1\r\nHost: a\r\n";
  EXPECT_EQ(statusOf(server.talk(begin + "X: " + std::string(2000, 'x') + "\r\n\r\n")), "HTTP/1.1 431");
  EXPECT_EQ(statusOf(server.talk(begin + "Content-Length: 101\r\n\r\n" + std::string(101, 'x'))), "HTTP/1.1 413");
  EXPECT_EQ(statusOf(server.talk(begin + "Transfer-Encoding: chunked\r\n\r\n65\r\n" + std::string(101, 'x') +
                                 "\r\n0\r\n\r\n")),
            "HTTP/1.1 413");
  EXPECT_EQ(statusOf(server.talk(begin + "Content-Encoding: gzip\r\nContent-Length: 1\r\n\r\nx")), "HTTP/1.1 415");
  EXPECT_EQ(statusOf(server.talk("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n")), "HTTP/1.1 400");
  EXPECT_EQ(statusOf(server.talk("GET /%zz HTTP/1.1\r\nHost: a\r\n\r\n")), "HTTP/1.1 400");
  EXPECT_EQ(statusOf(server.talk("GET http://a/ HTTP/1.1\r\nHost: a\r\n\r\n")), "HTTP/1.1 400");
  EXPECT_EQ(statusOf(server.talk("no request at all\r\n\r\n")), "HTTP/1.1 400");
  EXPECT_EQ(statusOf(server.talk(std::string(64, '\0') + "\r\n\r\n")), "HTTP/1.1 400");
  EXPECT_EQ(server.answered(), 0);
  EXPECT_EQ(statusOf(server.talk(begin + "Content-Length: 4\r\nConnection: close\r\n\r\nbody")), "HTTP/1.1 200");
}

TEST(HttpServer, SlowSendersHoldNobodyUpAndAreDisconnected) {
  HttpLimits limits;
  limits.request_s = 1;
  Running server(limits);
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 40; ++i) {
    slow.push_back(std::make_unique<Client>(server.port()));
    slow.back()->send("GET / HTTP/1.1\r\nHo");
  }
  EXPECT_EQ(statusOf(server.talk(std::string("GET / HTTP/1.1\r\n") + kClose)), "HTTP/1.1 200");
  for (const auto& client : slow) EXPECT_TRUE(client->isClosed());
  EXPECT_EQ(server.answered(), 1);
}

TEST(HttpServer, WhoIsIdleIsDisconnected) {
  HttpLimits limits;
  limits.idle_s = 1;
  Running server(limits);
  Client client(server.port());
  EXPECT_TRUE(client.isClosed());
}

TEST(HttpServer, ConnectionsBeyondTheLimitAreRefused) {
  HttpLimits limits;
  limits.connections = 3;
  Running server(limits);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<Client>(server.port()));
    clients.back()->send("GET / HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(statusOf(clients.back()->readTo("GET / ")), "HTTP/1.1 200");
  }
  EXPECT_EQ(statusOf(server.talk("")), "HTTP/1.1 503");
  clients.pop_back();
  std::string answer;
  do {
    answer = server.talk(std::string("GET / HTTP/1.1\r\n") + kClose);
  } while (statusOf(answer) == "HTTP/1.1 503");  // until the server has seen that one is gone
  EXPECT_EQ(statusOf(answer), "HTTP/1.1 200");
}

TEST(HttpServer, RequestsBeyondTheRateAreRefused) {
  HttpLimits limits;
  limits.requests_at_once = 5;
  limits.requests_per_s = 1e-3;
  Running server(limits);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(statusOf(server.talk(std::string("GET / HTTP/1.1\r\n") + kClose)), "HTTP/1.1 200");
  EXPECT_EQ(statusOf(server.talk(std::string("GET / HTTP/1.1\r\n") + kClose)), "HTTP/1.1 429");
  EXPECT_EQ(server.answered(), 5);
}

TEST(HttpServer, UrgentRequestsAreAnsweredBeyondTheRate) {
  HttpLimits limits;
  limits.requests_at_once = 1;
  limits.requests_per_s = 1e-3;
  Running server(limits, [](const HttpRequest& request) { return request.method == "POST"; });
  const auto status = [&](const std::string& method) {
    return statusOf(server.talk(method + " / HTTP/1.1\r\nContent-Length: 0\r\n" + kClose));
  };
  EXPECT_EQ(status("GET"), "HTTP/1.1 200");
  EXPECT_EQ(status("GET"), "HTTP/1.1 429");
  EXPECT_EQ(status("POST"), "HTTP/1.1 200");
  EXPECT_EQ(status("POST"), "HTTP/1.1 200");
}

/// Memory of this process that is in use [bytes].
double residentBytes() {
  std::ifstream in("/proc/self/statm");
  double all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

TEST(HttpServer, AFileIsSentAsItIs) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "a.ply", std::ios::binary) << "ply\r\n" << std::string(10000, '\0') << "end";
  Running server;
  const std::string target = "/file?name=" + (folder / "a.ply");
  Client client(server.port());
  for (int i = 0; i < 2; ++i) {
    client.send("GET " + target + " HTTP/1.1\r\nHost: a\r\n\r\n");
    const std::string answer = client.readTo("end");
    EXPECT_NE(answer.find("Content-Length: 10008\r\n"), std::string::npos) << answer.substr(0, 200);
    EXPECT_EQ(answer.substr(answer.size() - 10008, 6), std::string("ply\r\n\0", 6));
  }
  const std::string head = server.talk("HEAD " + target + " HTTP/1.1\r\n" + kClose);
  EXPECT_NE(head.find("Content-Length: 10008\r\n"), std::string::npos) << head;
  EXPECT_EQ(head.substr(head.size() - 4), "\r\n\r\n");
  EXPECT_EQ(statusOf(server.talk("GET " + target + "x HTTP/1.1\r\n" + kClose)), "HTTP/1.1 404");
}

TEST(HttpServer, ClientsThatDoNotReadAFileCostNoMemory) {
  constexpr int kClients = 8;
  constexpr double kBytes = 48 << 20;
  const testing::ScratchFolder folder;
  std::ofstream(folder / "large.ply");
  std::filesystem::resize_file(folder / "large.ply", static_cast<std::uintmax_t>(kBytes));
  Running server;
  const double before = residentBytes();
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.push_back(std::make_unique<Client>(server.port()));
    clients.back()->send("GET /file?name=" + (folder / "large.ply") + " HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(statusOf(clients.back()->readTo("\r\n\r\n")), "HTTP/1.1 200");
  }
  EXPECT_LT(residentBytes() - before, kBytes) << "less than one copy of the file";
}

TEST(HttpServer, EventsReachEveryOpenStream) {
  HttpLimits limits;
  limits.event_streams = 2;
  Running server(limits);
  const std::string request = "GET /events HTTP/1.1\r\nHost: a\r\n\r\n";
  Client one(server.port()), other(server.port());
  for (Client* client : {&one, &other}) {
    client->send(request);
    EXPECT_EQ(statusOf(client->readTo("data: first\n\n")), "HTTP/1.1 200");
  }
  EXPECT_EQ(statusOf(server.talk(request)), "HTTP/1.1 503") << "a third stream";
  server.sendEvent("second");
  for (Client* client : {&one, &other}) EXPECT_EQ(client->readTo("\n\n"), "data: second\n\n");
}

TEST(HttpServer, AStreamThatIsNotReadIsClosedAndTheOthersGoOn) {
  HttpLimits limits;
  limits.unsent_bytes = 4 * 1024 * 1024;
  Running server(limits);
  const std::string request = "GET /events HTTP/1.1\r\nHost: a\r\n\r\n";
  Client slow(server.port()), good(server.port());
  for (Client* client : {&slow, &good}) {
    client->send(request);
    client->readTo("data: first\n\n");
  }
  // The system buffers some megabytes of a connection, too.
  for (int i = 0; i < 12; ++i) {
    server.sendEvent(std::string(1024 * 1024, 'e'));
    EXPECT_EQ(good.readTo("\n\n").size(), 1024 * 1024 + 8);
  }
  EXPECT_LT(slow.readAll().size(), 12U * 1024 * 1024) << "it was closed before its end";
}

TEST(HttpServer, ATakenPortAndAWrongAddressAreRefusedWithTheRemedy) {
  Running server;
  const auto handler = [](const HttpRequest&) { return HttpResponse(); };
  try {
    HttpServer second("127.0.0.1", server.port(), {}, handler);
    ADD_FAILURE() << "the port is taken";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("choose another"), std::string::npos) << error.what();
  }
  EXPECT_THROW(HttpServer("nowhere", 0, {}, handler), base::Error);
  EXPECT_TRUE(isLoopback("127.0.0.1") && isLoopback("::1") && !isLoopback("0.0.0.0") && !isLoopback("localhost"));
}

/// A request some bytes of which are changed, left out, put in or repeated.
std::string mutated(std::string request, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return random() % count; };
  for (auto changes = below(5); changes > 0 && !request.empty(); --changes) {
    const auto at = below(request.size());
    const auto kind = below(4);
    if (kind == 0) request[at] = static_cast<char>(below(256));
    if (kind == 1) request.erase(at, 1 + below(8));
    if (kind == 2) request.insert(at, 1 + below(20), static_cast<char>(below(256)));
    if (kind == 3)
      for (auto times = below(50); times > 0; --times) request.insert(at, request.substr(at, 30));
  }
  return request;
}

TEST(HttpServer, MutatedRequestsAreAnsweredOrClosedAndNoneEndsIt) {
  constexpr int kRequests = 2000;
  HttpLimits limits;
  limits.requests_per_s = limits.requests_at_once = 1e6;
  Running server(limits);
  const std::vector<std::string> requests{
      "GET /api/query?q=path+kitchen+to+213 HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n",
      "POST /api/edit HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\nContent-Length: "
      "12\r\n\r\n{\"words\":[]}",
      "POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
      "GET /events HTTP/1.1\r\nHost: a\r\nCookie: x=1; y=2\r\n\r\n"};
  std::mt19937 random(7);
  for (int i = 0; i < kRequests; ++i) {
    Client client(server.port());
    client.send(mutated(requests[random() % requests.size()], random));
    client.finish();
    const std::string answer = client.readAll();
    EXPECT_TRUE(answer.empty() || answer.substr(0, 9) == "HTTP/1.1 ") << answer.substr(0, 40);
  }
  EXPECT_EQ(statusOf(server.talk(std::string("GET / HTTP/1.1\r\n") + kClose)), "HTTP/1.1 200");
}

TEST(HttpMessage, TargetsAreDecoded) {
  HttpRequest request;
  ASSERT_TRUE(readTarget("/a%20b?q=caf%C3%A9+au+lait&q=tea&empty=&flag", request));
  EXPECT_EQ(request.path, "/a b");
  EXPECT_EQ(request.values.at("q"), "caf\xC3\xA9 au lait");
  EXPECT_EQ(request.values.at("empty"), "");
  EXPECT_EQ(request.values.count("flag"), 1U);
  for (const char* damaged : {"", "a", "*", "/%", "/%4", "/%zz", "/%00", "/?a=%0a"})
    EXPECT_FALSE(readTarget(damaged, request)) << damaged;
}

}  // namespace
}  // namespace omnimapper::server::http_server_test
