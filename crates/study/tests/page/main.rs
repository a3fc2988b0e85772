//! The report page in a real browser: it loads from its one file, works by keyboard and by mouse, in light and in dark, and tells
//! assistive technology what it shows.
//!
//! Without Chromium these tests are skipped, each saying so with a running number; where `BOSSAGE_REQUIRE` lists `chromium` they fail.
//! `BOSSAGE_KEEP=FOLDER` keeps the pages and their screenshots to look at.

#![cfg(unix)]

mod browser;
#[path = "../../src/sample.rs"]
mod sample;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use bossage_conformance::Route;
use bossage_conformance::bench::Bench;
use bossage_embedded::Embedded;
use bossage_shaders::Library;
use bossage_study::pictures::{self, Pictured};
use bossage_study::record;
use bossage_study::report::{self, Files, Pair, Shot};
use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use tempfile::TempDir;

use browser::Browser;

/// The report that all tests open.
static REPORT: LazyLock<Files> = LazyLock::new(|| {
    let mut study = sample::study();
    bossage_study::pareto::mark(&mut study.points);
    report::files(&study, &[pair("bricks"), pair("dunes")]).unwrap()
});

/// A folder with a report, and whatever a test adds.
struct Folder(TempDir);

impl Folder {
    fn with_report() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for (name, bytes) in REPORT.iter() {
            std::fs::write(folder.0.path().join(name), bytes).unwrap();
        }
        folder
    }

    fn with_page(html: &str) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        std::fs::write(folder.0.path().join(report::PAGE), html).unwrap();
        folder
    }

    fn url(&self) -> String {
        format!("file://{}", self.0.path().join(report::PAGE).display())
    }
}

/// A gradient, and the same shifted.
fn pair(name: &str) -> Pair {
    let shot = |label: &str, shift: u32| Shot {
        label: label.to_owned(),
        image: RgbImage::from_fn(96, 64, |x, y| Rgb([(2 * x + shift) as u8, (3 * y) as u8, 90])),
    };
    Pair {
        name: name.to_owned(),
        title: format!("{name}, from the side"),
        reference: shot("exact", 0),
        test: shot("parallax_offset", 40),
        rerun: "bossage render SCENE --compare parallax_offset,exact -o out.png".to_owned(),
    }
}

/// A started browser with the report open.
fn report_in_browser(test: &str) -> Option<(Browser, Folder)> {
    let mut browser = Browser::start(test)?;
    let folder = Folder::with_report();
    browser.resize(1280, 900);
    browser.open(&folder.url());
    Some((browser, folder))
}

/// Everything that a page did wrong while it loaded: requests to elsewhere, errors, messages of the policy.
fn complaints(browser: &mut Browser) -> Vec<String> {
    let mut found = Vec::new();
    for event in browser.events("Network.requestWillBeSent") {
        let url = event["request"]["url"].as_str().unwrap_or_default().to_owned();
        if !url.starts_with("data:") && !url.ends_with(report::PAGE) {
            found.push(format!("asks for {url}"));
        }
    }
    for event in browser.events("Runtime.exceptionThrown") {
        found.push(format!("throws {}", event["exceptionDetails"]));
    }
    for event in browser.events("Runtime.consoleAPICalled") {
        found.push(format!("says {}", event["args"]));
    }
    for event in browser.events("Log.entryAdded") {
        found.push(format!("logs {}", event["entry"]["text"]));
    }
    found
}

#[test]
fn the_page_needs_no_network_and_makes_no_complaint() {
    let Some((mut browser, _folder)) = report_in_browser("network") else {
        return;
    };
    assert_eq!(complaints(&mut browser), Vec::<String>::new());
    let broken = "[...document.images].filter((image) => !image.complete || image.naturalWidth === 0).length";
    assert_eq!(browser.evaluate(broken), json!(0));
    assert_eq!(browser.evaluate("document.images.length"), json!(6));

    let bad = Folder::with_page(
        "<!DOCTYPE html><title>x</title><img src='other.png'><script>console.error('no'); missing()</script>",
    );
    browser.open(&bad.url());
    let found = complaints(&mut browser).join("\n");
    for part in ["asks for file://", "throws", "says"] {
        assert!(found.contains(part), "{part} in {found}");
    }
}

#[test]
fn the_policy_keeps_the_page_from_fetching() {
    let Some((mut browser, _folder)) = report_in_browser("policy") else {
        return;
    };
    let attempt = "new Promise((done) => { const image = new Image(); image.onload = () => done('loaded'); image.onerror = () => done('refused'); image.src = 'time-bricks-30.png'; })";
    assert_eq!(
        browser.evaluate(attempt),
        json!("refused"),
        "a file that is there"
    );
    let free = Folder::with_page("<!DOCTYPE html><title>x</title>");
    let picture = "time-bricks-30.png";
    std::fs::write(free.0.path().join(picture), &REPORT[picture]).unwrap();
    browser.open(&free.url());
    assert_eq!(browser.evaluate(attempt), json!("loaded"), "without a policy");
}

/// The report of two techniques over the bundled wall, drawn small and without a driver.
fn report_of_a_scene() -> Files {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/brick_wall.toml");
    let wall = Pictured {
        name: "brick_wall".to_owned(),
        scene: bossage_scene::load(path.as_ref()).unwrap(),
    };
    let drawn_by = |technique: &str, settings| record::Point {
        technique: technique.to_owned(),
        settings,
        scene: Some(record::SceneError {
            scene: wall.name.clone(),
            ..record::SceneError::default()
        }),
        ..record::Point::default()
    };
    let mut study = record::Study {
        points: vec![
            drawn_by("parallax_offset", record::Settings::default()),
            drawn_by("parallax_occlusion", record::Settings::of([("layers", 16.0)])),
        ],
        ..record::Study::default()
    };
    let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
    let bench = Bench::new(&machine, Route::Embedded, &library);
    let pairs = pictures::compare(&[wall.at_most(96)], &mut study, &bench, &mut |_| ()).unwrap();
    report::files(&study, &pairs).unwrap()
}

/// Of each pair: how many bytes its pictures have, in how many both differ, how many values its error map has.
const PAIRS: &str = "(() => { const bytes = (image) => { const canvas = document.createElement('canvas'); \
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight]; const to = canvas.getContext('2d'); to.drawImage(image, 0, 0); \
    return [...to.getImageData(0, 0, canvas.width, canvas.height).data]; }; \
    return [...document.querySelectorAll('.pair')].map((pair) => { const [test, reference, map] = [...pair.querySelectorAll('img')].map(bytes); \
    return [test.length, test.filter((value, at) => value !== reference[at]).length, new Set(map).size]; }); })()";

#[test]
fn the_pictures_of_a_scene_are_there_and_differ_from_the_truth() {
    let Some(mut browser) = Browser::start("pictures") else {
        return;
    };
    let folder = Folder::with_page("");
    for (name, bytes) in report_of_a_scene() {
        std::fs::write(folder.0.path().join(name), bytes).unwrap();
    }
    browser.resize(1280, 900);
    browser.open(&folder.url());
    assert_eq!(complaints(&mut browser), Vec::<String>::new());
    let pairs = browser.evaluate(PAIRS);
    let number = |pair: usize, index: usize| pairs[pair][index].as_u64().unwrap();
    assert_eq!(pairs.as_array().unwrap().len(), 2, "one a technique");
    for pair in [0, 1] {
        assert_eq!(number(pair, 0), 96 * 72 * 4);
        assert!(number(pair, 1) > 1000 && number(pair, 2) > 50, "{pairs}");
    }
    // By name: parallax_occlusion, then parallax_offset, which is farther off.
    assert!(number(1, 1) > number(0, 1), "{pairs}");
    let (_, text, _) = slider(&mut browser);
    assert_eq!(
        text,
        "50 % the first hit in f64, 50 % parallax_occlusion layers=16"
    );
    // The control: a picture of the truth itself would be seen.
    browser.evaluate("document.querySelector('.pair img').src = document.querySelector('.pair .over').src");
    browser.evaluate("document.querySelector('.pair img').decode()");
    assert_eq!(browser.evaluate(PAIRS)[0][1], json!(0));
}

/// Value, text and place of the first slider's border.
fn slider(browser: &mut Browser) -> (i64, String, String) {
    let state = browser.evaluate(
        "(() => { const input = document.querySelector('.slider input'); const over = document.querySelector('.slider .over'); \
         return [Number(input.value), input.getAttribute('aria-valuetext'), getComputedStyle(over).clipPath]; })()",
    );
    let word = |index: usize| state[index].as_str().unwrap_or_default().to_owned();
    (state[0].as_i64().unwrap(), word(1), word(2))
}

#[test]
fn the_slider_moves_by_keyboard_and_by_drag() {
    let Some((mut browser, _folder)) = report_in_browser("slider") else {
        return;
    };
    let (value, text, clip) = slider(&mut browser);
    assert_eq!((value, text.as_str()), (50, "50 % exact, 50 % parallax_offset"));
    browser.evaluate("document.querySelector('.slider input').focus()");
    browser.press("ArrowRight");
    let (right, right_text, right_clip) = slider(&mut browser);
    assert_eq!(
        (right, right_text.as_str()),
        (51, "51 % exact, 49 % parallax_offset")
    );
    assert_ne!(right_clip, clip, "the picture follows");
    browser.press("Home");
    assert_eq!(slider(&mut browser).0, 0);
    browser.press("End");
    assert_eq!(slider(&mut browser).0, 100);

    let place = browser.evaluate(
        "(() => { const box = document.querySelector('.slider'); box.scrollIntoView({ block: 'center' }); \
         const r = box.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; })()",
    );
    let number = |index: usize| place[index].as_f64().unwrap();
    let at = |share: f64| [number(0) + share * number(2), number(1) + number(3) / 2.0];
    browser.drag(at(0.9), at(0.25));
    let (dragged, ..) = slider(&mut browser);
    assert!((20..=30).contains(&dragged), "{dragged}");
}

/// Where the focus is: its number among all elements, what it is, and how it is shown.
const FOCUS: &str = "(() => { const at = document.activeElement; \
    const style = getComputedStyle(at.closest('.slider') ?? at); \
    return { number: [...document.querySelectorAll('*')].indexOf(at), name: at.tagName + ' ' + (at.getAttribute('aria-label') ?? at.textContent), \
    shown: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0 }; })()";

#[test]
fn tab_reaches_everything_in_reading_order_and_shows_where_it_is() {
    let Some((mut browser, _folder)) = report_in_browser("focus") else {
        return;
    };
    let reachable =
        browser.evaluate("document.querySelectorAll('a[href], button, input, [tabindex=\"0\"]').length");
    let reachable = reachable.as_u64().unwrap();
    let mut last = -1;
    for step in 0..reachable {
        browser.press("Tab");
        let focus = browser.evaluate(FOCUS);
        let number = focus["number"].as_i64().unwrap();
        assert!(
            number > last,
            "step {step} of {reachable} goes back to {}",
            focus["name"]
        );
        assert_eq!(
            focus["shown"],
            json!(true),
            "{} does not show the focus",
            focus["name"]
        );
        if step == 0 {
            assert!(focus["name"].as_str().unwrap().contains("Skip to"), "{focus}");
        }
        last = number;
    }
    browser.evaluate("document.head.append(Object.assign(document.createElement('style'), { textContent: '* { outline: none !important; }' }))");
    assert_eq!(
        browser.evaluate(FOCUS)["shown"],
        json!(false),
        "a page that hides the focus is seen"
    );
}

#[test]
fn tables_sort_by_keyboard_and_say_so() {
    let Some((mut browser, _folder)) = report_in_browser("sort") else {
        return;
    };
    let column =
        "[...document.querySelectorAll('#points tbody tr')].map((row) => Number(row.cells[6].dataset.sort))";
    let head = "document.querySelectorAll('#points thead th')[6]";
    let numbers = |value: Value| -> Vec<f64> {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|n| n.as_f64().unwrap())
            .collect()
    };
    assert_eq!(browser.evaluate(&format!("{head}.textContent")), json!("p99"));
    assert!(!numbers(browser.evaluate(column)).is_sorted());
    browser.evaluate(&format!("{head}.querySelector('button').focus()"));
    browser.press("Enter");
    assert!(numbers(browser.evaluate(column)).is_sorted());
    assert_eq!(
        browser.evaluate(&format!("{head}.getAttribute('aria-sort')")),
        json!("ascending")
    );
    browser.press("Enter");
    assert!(numbers(browser.evaluate(column)).is_sorted_by(|a, b| a >= b));
    assert_eq!(
        browser.evaluate(&format!("{head}.getAttribute('aria-sort')")),
        json!("descending")
    );
    assert_eq!(
        browser.evaluate("document.querySelectorAll('#points [aria-sort]').length"),
        json!(1)
    );
    // What was not timed stays last, either way.
    let time = "document.querySelectorAll('#prices-table thead button')[6]";
    for _ in 0..2 {
        browser.evaluate(&format!("{time}.click()"));
        let last = browser
            .evaluate("[...document.querySelectorAll('#prices-table tbody tr')].at(-1).cells[6].textContent");
        assert!(last.as_str().unwrap().starts_with("not timed"), "{last}");
    }
}

#[test]
fn light_and_dark_follow_the_reader() {
    let Some((mut browser, _folder)) = report_in_browser("scheme") else {
        return;
    };
    let colours = "(() => { const style = (at) => getComputedStyle(document.querySelector(at)); \
        return [style('body').backgroundColor, style('body').color, style('.chart rect').fill, style('.chart text').fill]; })()";
    browser.prefer("light");
    let light = browser.evaluate(colours);
    assert_eq!(
        light,
        json!([
            "rgb(255, 255, 255)",
            "rgb(27, 27, 27)",
            "rgb(255, 255, 255)",
            "rgb(27, 27, 27)"
        ])
    );
    browser.prefer("dark");
    let dark = browser.evaluate(colours);
    assert_eq!(
        dark,
        json!([
            "rgb(22, 22, 22)",
            "rgb(236, 236, 236)",
            "rgb(22, 22, 22)",
            "rgb(236, 236, 236)"
        ])
    );
}

/// What is wrong for those who can't see the page, by rules that a program can hold. Many come from WCAG 2.2.
const FAULTS: &str = include_str!("faults.js");

/// Roles that must have a name.
const NAMED: [&str; 8] = [
    "image",
    "link",
    "button",
    "slider",
    "region",
    "table",
    "navigation",
    "RootWebArea",
];

fn faults(browser: &mut Browser) -> BTreeSet<String> {
    let list = browser.evaluate(FAULTS);
    let mut found: BTreeSet<String> = list
        .as_array()
        .unwrap()
        .iter()
        .map(|fault| fault.as_str().unwrap().to_owned())
        .collect();
    for (role, name) in browser.told() {
        if NAMED.contains(&role.as_str()) && name.trim().is_empty() {
            found.insert(format!("no name: {role}"));
        }
    }
    found
}

#[test]
fn everything_has_a_name_an_order_and_contrast() {
    let Some((mut browser, _folder)) = report_in_browser("names") else {
        return;
    };
    for scheme in ["light", "dark"] {
        browser.prefer(scheme);
        assert_eq!(faults(&mut browser), BTreeSet::new(), "{scheme}");
    }
    let told = browser.told();
    let count = |role: &str| told.iter().filter(|(told, _)| told == role).count();
    assert_eq!((count("main"), count("navigation"), count("slider")), (1, 1, 2));
    let front = "Error against time on bricks, seen 75° from the normal";
    assert!(
        told.iter()
            .any(|(role, name)| role == "image" && name.contains(front)),
        "charts are told as pictures in words"
    );
}

#[test]
fn each_kind_of_fault_is_found() {
    let Some(mut browser) = Browser::start("faults") else {
        return;
    };
    let folder = Folder::with_report();
    for (spoil, fault) in [
        ("document.images[0].removeAttribute('alt')", "no alt"),
        (
            "document.querySelector('svg.chart').removeAttribute('aria-label')",
            "no name: image",
        ),
        (
            "document.querySelector('.slider input').removeAttribute('aria-label')",
            "no name: slider",
        ),
        (
            "document.querySelector('nav').removeAttribute('aria-label')",
            "no name: navigation",
        ),
        (
            "document.querySelector('figcaption a').replaceChildren()",
            "no name: link",
        ),
        (
            "document.querySelector('caption').remove()",
            "table without caption",
        ),
        (
            "document.querySelector('thead th').removeAttribute('scope')",
            "head without scope",
        ),
        (
            "document.querySelector('h2').outerHTML = '<h4>Time</h4>'",
            "heading skips",
        ),
        ("document.body.append(document.createElement('h1'))", "not one h1"),
        ("document.querySelector('main').id = 'time'", "id twice"),
        ("document.querySelector('section').id = 'gone'", "leads nowhere"),
        ("document.documentElement.removeAttribute('lang')", "no language"),
        (
            "document.querySelector('figcaption').style.color = '#999'",
            "contrast",
        ),
    ] {
        browser.open(&folder.url());
        browser.prefer("light");
        browser.evaluate(spoil);
        let found = faults(&mut browser);
        assert!(
            found.iter().any(|found| found.contains(fault)),
            "{spoil}: {fault} is not in {found:?}"
        );
    }
}

#[test]
fn a_narrow_window_scrolls_in_one_direction_only() {
    let Some((mut browser, folder)) = report_in_browser("narrow") else {
        return;
    };
    for width in [1280, 390] {
        browser.resize(width, 900);
        let wide = browser
            .evaluate("document.documentElement.scrollWidth")
            .as_u64()
            .unwrap();
        assert!(wide <= u64::from(width), "{wide} of {width}");
    }
    browser.evaluate("document.body.style.width = '500px'");
    assert!(
        browser
            .evaluate("document.documentElement.scrollWidth")
            .as_u64()
            .unwrap()
            > 390,
        "a page that is too wide is seen"
    );
    browser.open(&folder.url());
    if let Some(keep) = std::env::var_os("BOSSAGE_KEEP") {
        keep_pictures(&mut browser, &PathBuf::from(keep));
    }
}

fn keep_pictures(browser: &mut Browser, folder: &Path) {
    for scheme in ["light", "dark"] {
        for width in [1280, 390] {
            let picture = browser.screenshot(scheme, width);
            std::fs::write(folder.join(format!("page-{scheme}-{width}.png")), picture).unwrap();
        }
    }
}
