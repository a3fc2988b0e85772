//! A headless Chromium, driven by its debugging protocol through a pair of pipes.
//!
//! A client of a hundred lines instead of a crate: those that there are generate the whole protocol, some 60,000 lines, of which the
//! tests call a dozen methods. Each message is JSON and ends with a zero byte; the browser reads on descriptor 3 and writes on 4.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use base64::Engine;
use serde_json::{Value, json};
use tempfile::TempDir;

/// Names under which the browser is looked for.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// It draws by itself, and talks to nobody.
const FLAGS: [&str; 11] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
];
/// An answer that takes longer does not come any more.
const PATIENCE: Duration = Duration::from_secs(60);

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// One browser with one page.
pub(crate) struct Browser {
    child: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    sent: u64,
    session: Option<String>,
    events: Vec<Value>,
    _profile: TempDir,
}

impl Browser {
    /// Starts one, or says that the test is skipped.
    ///
    /// # Panics
    /// Where there is none though `BOSSAGE_REQUIRE` lists `chromium`.
    pub(crate) fn start(test: &str) -> Option<Self> {
        let Some(program) = NAMES.into_iter().find(|name| is_there(name)) else {
            let required = std::env::var("BOSSAGE_REQUIRE")
                .is_ok_and(|list| list.split(',').any(|name| name.trim() == "chromium"));
            assert!(
                !required,
                "chromium is required, and none of {NAMES:?} is on the PATH"
            );
            let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
            let mut stderr = std::io::stderr();
            writeln!(stderr, "SKIP {count}: {test}: no Chromium; ./x setup installs it")
                .expect("standard error can be written");
            return None;
        };
        let mut browser = Self::launch(program);
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.call("Target.attachToTarget", attach);
        browser.session = session["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network", "Accessibility"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        Some(browser)
    }

    fn launch(program: &str) -> Self {
        let profile = tempfile::tempdir().expect("a profile folder can be made");
        let mut child = Command::new("sh")
            .arg("-c")
            .arg("exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >&2")
            .arg(program)
            .args(FLAGS)
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("sh runs");
        let to = child.stdin.take().expect("it is piped");
        let from = listen(BufReader::new(child.stdout.take().expect("it is piped")));
        Self {
            child,
            to,
            from,
            sent: 0,
            session: None,
            events: Vec::new(),
            _profile: profile,
        }
    }

    /// Calls a method and returns its result; what happens meanwhile is kept.
    pub(crate) fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        write!(self.to, "{message}\0").expect("the browser listens");
        self.to.flush().expect("the browser listens");
        loop {
            let answer = self.next(method);
            if answer["id"] == json!(self.sent) {
                assert!(answer.get("error").is_none(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.events.push(answer);
        }
    }

    fn next(&self, waiting_for: &str) -> Value {
        let got = self.from.recv_timeout(PATIENCE);
        got.unwrap_or_else(|error| panic!("no answer from the browser to {waiting_for}: {error}"))
    }

    /// Opens a page and waits until it is loaded. What was kept before is forgotten.
    pub(crate) fn open(&mut self, url: &str) {
        self.events.clear();
        self.call("Page.navigate", json!({ "url": url }));
        while !self
            .events
            .iter()
            .any(|event| event["method"] == "Page.loadEventFired")
        {
            let event = self.next("Page.loadEventFired");
            self.events.push(event);
        }
    }

    /// What happened since the page was opened, by method.
    pub(crate) fn events(&mut self, method: &str) -> Vec<Value> {
        // An answer comes after the events before it.
        self.evaluate("0");
        let of_method = self.events.iter().filter(|event| event["method"] == method);
        of_method.map(|event| event["params"].clone()).collect()
    }

    /// The value of an expression in the page.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let result = self.call("Runtime.evaluate", parameters);
        assert!(result.get("exceptionDetails").is_none(), "{expression}: {result}");
        result["result"]["value"].clone()
    }

    /// The window's size, in pixels of style sheets.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", size);
    }

    /// `light` or `dark`, as the reader's system would say.
    pub(crate) fn prefer(&mut self, scheme: &str) {
        let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", features);
    }

    /// Presses and lets go of a key.
    pub(crate) fn press(&mut self, key: &str) {
        let (code, text) = match key {
            "Tab" => (9, ""),
            "Enter" => (13, "\r"),
            "ArrowLeft" => (37, ""),
            "ArrowRight" => (39, ""),
            "Home" => (36, ""),
            "End" => (35, ""),
            _ => panic!("no code for the key {key}"),
        };
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({ "type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code });
            if kind == "keyDown" && !text.is_empty() {
                event["text"] = json!(text);
            }
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Presses the left button at a place, moves, and lets go.
    pub(crate) fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        for (kind, [x, y], buttons) in [
            ("mouseMoved", from, 0),
            ("mousePressed", from, 1),
            ("mouseMoved", to, 1),
            ("mouseReleased", to, 0),
        ] {
            // A move without its button is no drag.
            let button = if kind == "mouseMoved" && buttons == 0 {
                "none"
            } else {
                "left"
            };
            let event = json!({ "type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// What assistive technology is told: role and name of everything that is not hidden from it.
    pub(crate) fn told(&mut self) -> Vec<(String, String)> {
        let tree = self.call("Accessibility.getFullAXTree", json!({}));
        let nodes = tree["nodes"].as_array().expect("a list");
        let shown = nodes.iter().filter(|node| node["ignored"] != json!(true));
        let word = |value: &Value| value["value"].as_str().unwrap_or_default().to_owned();
        shown
            .map(|node| (word(&node["role"]), word(&node["name"])))
            .collect()
    }

    /// The whole page as it is seen, PNG.
    pub(crate) fn screenshot(&mut self, scheme: &str, width: u32) -> Vec<u8> {
        self.prefer(scheme);
        self.resize(width, 900);
        let picture = self.call("Page.captureScreenshot", json!({ "captureBeyondViewport": true }));
        let data = picture["data"].as_str().expect("base64");
        base64::engine::general_purpose::STANDARD
            .decode(data)
            .expect("base64")
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // Without its pipe the browser ends; this is for one that hangs.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn is_there(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

/// Messages in a channel, so that waiting for them can end.
fn listen(mut from: impl BufRead + Send + 'static) -> Receiver<Value> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let mut message = Vec::new();
        while from.read_until(0, &mut message).is_ok_and(|read| read > 0) {
            message.pop();
            let Ok(value) = serde_json::from_slice(&message) else {
                break;
            };
            if sender.send(value).is_err() {
                break;
            }
            message.clear();
        }
    });
    receiver
}
