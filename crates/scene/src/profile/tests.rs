use std::path::Path;

use super::{Cost, Profile, TECHNIQUES};

const GOOD: &str = "\
schema = 1
name = \"mine\"
adapter = \"a \\\"card\\\"\"
driver = \"1.0\"

[technique.exact]
ray_ns = 12.5
step_ns = 0.75
residual = 0.04
points = 20

[technique.parallax_offset]
ray_ns = 3
step_ns = 0
";

fn parse(text: &str) -> Result<Profile, String> {
    Profile::parse(Path::new("p.toml"), text).map_err(|report| report.to_string())
}

#[test]
fn figures_are_read_and_written_back_the_same() {
    let profile = parse(GOOD).unwrap();
    assert_eq!(profile.adapter, "a \"card\"");
    let exact = Cost {
        ray_ns: 12.5,
        step_ns: 0.75,
        residual: Some(0.04),
        points: Some(20),
    };
    assert_eq!(profile.techniques["exact"], exact);
    assert_eq!(exact.ns(10.0), 20.0);
    assert_eq!(profile.techniques["parallax_offset"].ns(0.0), 3.0);
    assert_eq!(profile.techniques.len(), 2);
    assert_eq!(parse(&profile.to_toml()).unwrap(), profile);
    let long = Profile {
        name: "line\nbreak".to_owned(),
        techniques: TECHNIQUES
            .map(|id| {
                (
                    id.to_owned(),
                    Cost {
                        ray_ns: 1.0 / 3.0,
                        ..exact
                    },
                )
            })
            .into(),
        ..profile
    };
    assert_eq!(parse(&long.to_toml()).unwrap(), long);
}

#[test]
fn what_is_wrong_is_shown_at_its_line() {
    // What is replaced, by what, the line and column that the message must name, and words of it.
    let cases = [
        ("schema = 1", "schema = 2", "p.toml:1:10", "schema 2 is not known"),
        ("schema = 1\n", "", "p.toml:1:1", "`schema` is missing"),
        (
            "name = \"mine\"",
            "name = \" \"",
            "p.toml:2:8",
            "this name is empty",
        ),
        (
            "driver = \"1.0\"",
            "driver = 1.0",
            "p.toml:4:10",
            "expected a string",
        ),
        ("driver", "drivr", "p.toml:4:1", "did you mean `driver`?"),
        ("12.5", "-12.5", "p.toml:7:10", "must be 0 or greater"),
        ("12.5", "nan", "p.toml:7:10", "NaN is not a usable number"),
        ("0.75", "inf", "p.toml:8:11", "infinity is not a usable number"),
        ("ray_ns = 3\n", "", "p.toml:12:1", "`ray_ns` is missing"),
        ("points = 20", "points = 0", "p.toml:10:10", "from 1 to"),
        ("points", "pionts", "p.toml:10:1", "did you mean `points`?"),
        (
            "technique.exact",
            "technique.exakt",
            "p.toml:6:12",
            "did you mean `exact`?",
        ),
        ("[technique.exact]", "[technique.exact", "p.toml:6:", "not TOML"),
    ];
    for (from, to, place, words) in cases {
        assert!(GOOD.contains(from), "{from}");
        let message = parse(&GOOD.replacen(from, to, 1)).unwrap_err();
        assert!(
            message.contains(place) && message.contains(words),
            "{from} -> {to}:\n{message}"
        );
        assert!(message.contains('^'), "a caret:\n{message}");
    }
}

#[test]
fn bundled_profiles_can_be_read_and_others_are_not_made_up() {
    let profile = Profile::bundled("lavapipe").unwrap();
    assert_eq!(profile.name, "lavapipe");
    assert!(profile.techniques.contains_key("parallax_offset"));
    let hint = Profile::bundled("lavapip").unwrap_err();
    assert!(hint.contains("did you mean `lavapipe`?"), "{hint}");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = Profile::load(Path::new("no/such/profile.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot read the cost profile no/such/profile.toml"
    );
}
