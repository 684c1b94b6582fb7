// SPDX-License-Identifier: Apache-2.0
// A headless Chromium that a test controls through its debugging pipe: pages, the mouse,
// screenshots.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "runtime/io/image/png.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

/// A mouse button, by its value in `button` and `buttons` of its events.
enum class MouseButton { left = 1, right = 2 };

/// One page of 640 x 480 pixels. Every failure throws a std::runtime_error.
class Browser {
  public:
    using Json = nlohmann::json;

    /// Uses `folder` for the browser's profile.
    explicit Browser(const std::filesystem::path& folder) : folder_(folder) {
        std::signal(SIGPIPE, SIG_IGN);  // without a browser, writing fails instead
        std::array<int, 2> to{}, from{};
        if (pipe(to.data()) != 0 || pipe(from.data()) != 0)
            throw std::runtime_error("no pipes for the browser");
        process_ = fork();
        if (process_ == 0) {
            setpgid(0, 0);
            // The numbers are above 4, so none is overwritten before it has moved.
            const int in = fcntl(to[0], F_DUPFD, 10), out = fcntl(from[1], F_DUPFD, 10);
            dup2(in, 3);
            dup2(out, 4);
            const int nowhere = open("/dev/null", O_RDWR);
            for (int i = 0; i < 3; ++i) dup2(nowhere, i);
            const std::string profile = "--user-data-dir=" + (folder / "profile").string();
            // The browser runs without a sandbox, because tests may run as root; the page is the
            // tests' own.
            execlp("chromium", "chromium", "--headless", "--no-sandbox", "--disable-gpu",
                   "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
                   "--remote-debugging-pipe", "--window-size=640,480", profile.c_str(),
                   static_cast<char*>(nullptr));
            _exit(127);
        }
        setpgid(process_, process_);  // repeated here, because the destructor may come first
        close(to[0]);
        close(from[1]);
        to_ = to[1], from_ = from[0];
    }
    ~Browser() {
        close(to_);
        close(from_);
        kill(-process_, SIGKILL);
        waitpid(process_, nullptr, 0);
        // The browser's own children may still be ending, just after creating or renaming a file of
        // the profile.
        std::error_code error;
        for (int tries = 0; tries < 300; ++tries) {
            remove_all(folder_ / "profile", error);
            if (!error) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    /// Opens a file and waits until its body has `data-ready`.
    void open_page(const std::filesystem::path& file) {
        const std::string target = ask("Target.createTarget", {{"url", "about:blank"}})["targetId"];
        session_ =
            ask("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})["sessionId"];
        ask("Network.enable", Json::object());
        ask("Emulation.setDeviceMetricsOverride",
            {{"width", 640}, {"height", 480}, {"deviceScaleFactor", 1}, {"mobile", false}});
        ask("Page.navigate", {{"url", "file://" + file.string()}});
        wait_for("document.body && document.body.dataset.ready === 'yes'");
    }

    Json evaluate(const std::string& expression) {
        return ask("Runtime.evaluate", {{"expression", expression}})["result"].value("value",
                                                                                     Json());
    }

    void wait_for(const std::string& expression) {
        for (int tries = 0; tries < 300; ++tries) {
            if (evaluate(expression) == true) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        throw std::runtime_error("the page never came to " + expression);
    }

    /// Presses the button, moves the mouse in four steps, and releases the button.
    void drag(int x, int y, int dx, int dy, MouseButton button = MouseButton::left) {
        const auto send = [&](const char* type, int step, int buttons) {
            ask("Input.dispatchMouseEvent",
                {{"type", type},
                 {"x", x + dx * step / 4},
                 {"y", y + dy * step / 4},
                 {"button", button == MouseButton::left ? "left" : "right"},
                 {"buttons", buttons},
                 {"clickCount", 1}});
        };
        send("mousePressed", 0, int(button));
        for (int step = 1; step <= 4; ++step) send("mouseMoved", step, int(button));
        send("mouseReleased", 4, 0);
    }

    Picture screenshot() {
        const std::string text = ask("Page.captureScreenshot", {{"format", "png"}})["data"];
        put_bytes(folder_ / "screenshot.png", from_base64(text));
        return read_png(folder_ / "screenshot.png");
    }

    /// The number of requests by the page, including the one for the page itself.
    int requests() const { return requests_; }

  private:
    static std::string from_base64(const std::string& text) {
        const std::string digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string bytes;
        unsigned bits = 0;
        int count = 0;
        for (const char c : text) {
            if (c == '=') break;
            bits = bits << 6 | unsigned(digits.find(c));
            if ((count += 6) >= 8) bytes += char(bits >> (count -= 8) & 255);
        }
        return bytes;
    }

    /// Sends a command and returns its answer; counts events that arrive meanwhile.
    Json ask(const std::string& method, const Json& parameters) {
        const int id = ++last_id_;
        Json message = {{"id", id}, {"method", method}, {"params", parameters}};
        if (!session_.empty()) message["sessionId"] = session_;
        const std::string text = message.dump();
        if (write(to_, text.c_str(), text.size() + 1) != ssize_t(text.size() + 1))
            throw std::runtime_error("the browser doesn't listen");
        for (;;) {
            const Json answer = read_message();
            requests_ += answer.value("method", "") == "Network.requestWillBeSent";
            if (answer.value("id", 0) != id) continue;
            if (answer.contains("error"))
                throw std::runtime_error(method + ": " + answer["error"].dump());
            return answer["result"];
        }
    }

    /// Reads a message; it ends with a zero byte.
    Json read_message() {
        size_t end = 0;
        while ((end = buffer_.find('\0')) == std::string::npos) {
            pollfd ready = {from_, POLLIN, 0};
            std::array<char, 65536> part{};
            const ssize_t size =
                poll(&ready, 1, 60000) == 1 ? read(from_, part.data(), part.size()) : 0;
            if (size <= 0) throw std::runtime_error("chromium isn't installed, or says nothing");
            buffer_.append(part.data(), size_t(size));
        }
        Json message = Json::parse(buffer_.substr(0, end));
        buffer_.erase(0, end + 1);
        return message;
    }

    std::filesystem::path folder_;
    pid_t process_ = -1;
    int to_ = -1, from_ = -1, last_id_ = 0, requests_ = 0;
    std::string buffer_, session_;
};

}  // namespace voxelume
