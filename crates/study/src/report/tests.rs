//! Reports of made-up studies.

use image::{Rgb, RgbImage};

use super::*;
use crate::flip;
use crate::record::{Point, Study};
use crate::sample;

fn text(files: &Files, name: &str) -> String {
    String::from_utf8(files[name].clone()).unwrap()
}

fn names(files: &Files) -> Vec<&str> {
    files.keys().map(String::as_str).collect()
}

fn of_points(points: Vec<Point>) -> Study {
    Study {
        points,
        ..Study::default()
    }
}

fn pair(name: &str, width: u32) -> Pair {
    let shot = |label: &str, width: u32| Shot {
        label: label.to_owned(),
        image: RgbImage::from_pixel(width, 8, Rgb([90, 60, 30])),
    };
    Pair {
        name: name.to_owned(),
        title: "A wall <of bricks>".to_owned(),
        reference: shot("exact", 8),
        test: shot("relief", width),
        rerun: "bossage render wall.toml".to_owned(),
    }
}

#[test]
fn each_chart_is_written_in_three_forms_beside_the_page() {
    let files = files(&sample::study(), &[pair("wall", 8)]).unwrap();
    for chart in [
        "time-bricks-30",
        "operations-dunes---hills-75",
        "angle-bricks",
        "price-arithmetic",
    ] {
        for ending in [".svg", ".png", "-dark.png"] {
            let name = format!("{chart}{ending}");
            assert!(files.contains_key(&name), "{name} of {:?}", names(&files));
        }
    }
    for (name, bytes) in &files {
        if name.ends_with(".png") {
            assert!(image::load_from_memory(bytes).is_ok(), "{name}");
        }
    }
    if let Some(folder) = std::env::var_os("BOSSAGE_KEEP") {
        for (name, bytes) in &files {
            std::fs::write(std::path::Path::new(&folder).join(name), bytes).unwrap();
        }
    }
}

#[test]
fn light_and_dark_pngs_have_another_ground_and_words_on_it() {
    let files = files(&of_points(vec![sample::point("exact", "bricks", 60.0)]), &[]).unwrap();
    for (name, ground, ink) in [
        ("time-bricks-60.png", 255, 27),
        ("time-bricks-60-dark.png", 22, 236),
    ] {
        let picture = image::load_from_memory(&files[name]).unwrap().to_rgb8();
        assert_eq!(picture.get_pixel(0, 0).0, [ground; 3], "{name}");
        // The title is at the top left: without its font there would be no ink.
        let title = picture.enumerate_pixels().filter(|(x, y, _)| *x < 600 && *y < 70);
        assert!(
            title.filter(|(.., pixel)| pixel.0 == [ink; 3]).count() > 200,
            "{name} has no title"
        );
    }
}

#[test]
fn a_small_chart_is_as_reviewed() {
    let point = sample::point("exact", "bricks", 60.0);
    let files = files(&of_points(vec![point]), &[]).unwrap();
    insta::assert_snapshot!("chart_of_one_point", text(&files, "time-bricks-60.svg"));
}

#[test]
fn an_empty_study_says_what_is_missing() {
    let files = files(&Study::default(), &[]).unwrap();
    assert_eq!(names(&files), [PAGE]);
    let page = text(&files, PAGE);
    for part in [
        "The study has no points.",
        "No pictures were drawn.",
        "Nothing was timed",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn without_times_there_are_operations_and_the_reason() {
    let mut point = sample::point("exact", "bricks", 60.0);
    point.time_ms = None;
    point.no_time = Some("no <driver>".to_owned());
    let files = files(&of_points(vec![point]), &[]).unwrap();
    assert!(files.contains_key("operations-bricks-60.svg") && !files.contains_key("time-bricks-60.svg"));
    let page = text(&files, PAGE);
    assert!(
        page.contains("not timed: no &lt;driver&gt;"),
        "the reason is in the table"
    );
}

#[test]
fn a_result_without_error_lies_on_a_floor_that_says_zero() {
    let mut exact = sample::point("exact", "bricks", 60.0);
    exact.error_texels = sample::errors(0.0);
    let rough = sample::point("relief", "bricks", 60.0);
    let with = files(&of_points(vec![exact, rough.clone()]), &[]).unwrap();
    let without = files(&of_points(vec![rough]), &[]).unwrap();
    // A tick label is a text element with its words on a line of their own.
    let has_zero = |files: &Files| {
        text(files, "time-bricks-60.svg")
            .lines()
            .any(|line| line.trim() == "0")
    };
    assert!(has_zero(&with) && !has_zero(&without));
}

#[test]
fn every_point_is_in_the_table_with_its_command_and_nothing_is_taken_for_markup() {
    let study = sample::study();
    let page = text(&files(&study, &[]).unwrap(), PAGE);
    for point in &study.points {
        let command = maud::html! { (point.rerun) }.into_string();
        assert!(page.contains(&command), "{command}");
    }
    assert!(page.contains("dunes &amp; hills") && !page.contains("dunes & hills"));
    assert!(page.contains("an adapter &lt;of ours&gt;"));
}

#[test]
fn the_page_holds_everything_that_it_shows() {
    let page = text(&files(&sample::study(), &[pair("wall", 8)]).unwrap(), PAGE);
    for outside in ["src=\"http", "src=\"//", "url(", "@import", "<link"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert_eq!(
        page.matches("<img").count(),
        page.matches("src=\"data:image/png;base64,").count()
    );
    assert!(page.contains("A wall &lt;of bricks&gt;"));
}

#[test]
fn names_that_would_be_one_file_are_refused() {
    let points = ["Wall", "wall"].map(|map| sample::point("exact", map, 60.0));
    let error = files(&of_points(points.into()), &[]).unwrap_err();
    assert!(matches!(error, Error::Collision(_)), "{error}");
    let error = files(&Study::default(), &[pair("a/b", 8), pair("a b", 8)]).unwrap_err();
    assert!(error.to_string().contains("picture-a-b-reference.png"), "{error}");
}

#[test]
fn pictures_of_two_sizes_are_refused_by_name() {
    let error = files(&Study::default(), &[pair("wall", 9)]).unwrap_err();
    assert_eq!(error.to_string(), "the pictures wall can't be compared");
    let Error::Pair { source, .. } = error else {
        panic!("another error: {error}")
    };
    assert_eq!(source, flip::Error::Sizes((8, 8), (9, 8)));
}

#[test]
fn a_figure_that_is_no_number_stops_the_report() {
    let mut study = sample::study();
    study.points[1].error_texels.p99 = f64::NAN;
    assert!(matches!(
        files(&study, &[]),
        Err(Error::Figure {
            field: "error_texels.p99",
            ..
        })
    ));
}
