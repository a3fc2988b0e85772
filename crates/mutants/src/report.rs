//! What a run found: shares by file and operator, every survivor, and whether that will do.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::time::Duration;

use serde::Serialize;

use crate::equivalent::List;
use crate::fate::Fate;
use crate::mutant::Mutant;

/// The share of the counted mutants that must be caught, in per cent.
pub(crate) const GOAL: f64 = 95.0;

/// A mutant with what became of it.
#[derive(Debug, Serialize)]
pub(crate) struct Row<'a> {
    #[serde(flatten)]
    pub(crate) mutant: &'a Mutant,
    #[serde(flatten)]
    pub(crate) fate: Fate,
    /// The reason for which it may survive, if it is listed.
    pub(crate) equivalent: Option<String>,
}

/// The results of a run.
#[derive(Debug, Serialize)]
pub(crate) struct Report<'a> {
    schema: u32,
    adapter: String,
    /// Whether every mutant was run.
    whole: bool,
    totals: Totals,
    mutants: Vec<Row<'a>>,
    #[serde(skip)]
    took: Duration,
}

/// Counts of fates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Totals {
    made: usize,
    invalid: usize,
    caught: usize,
    timed_out: usize,
    crashed: usize,
    survived: usize,
    unreached: usize,
}

impl Totals {
    fn add(&mut self, fate: &Fate) {
        self.made += 1;
        match fate {
            Fate::Invalid { .. } => self.invalid += 1,
            Fate::Caught { .. } => self.caught += 1,
            Fate::TimedOut { .. } => self.timed_out += 1,
            Fate::Crashed { .. } => self.crashed += 1,
            Fate::Survived { .. } => self.survived += 1,
            Fate::Unreached => self.unreached += 1,
        }
    }

    fn counted(self) -> usize {
        self.made - self.invalid
    }

    fn all_caught(self) -> usize {
        self.caught + self.timed_out + self.crashed
    }

    /// In per cent; all of none is all.
    fn share(self) -> f64 {
        match self.counted() {
            0 => 100.0,
            counted => 100.0 * self.all_caught() as f64 / counted as f64,
        }
    }
}

impl<'a> Report<'a> {
    pub(crate) fn new(
        adapter: String,
        whole: bool,
        mutants: &'a [Mutant],
        fates: Vec<Fate>,
        list: &List,
        took: Duration,
    ) -> Self {
        let mut totals = Totals::default();
        fates.iter().for_each(|fate| totals.add(fate));
        let row = |(mutant, fate)| Row {
            mutant,
            fate,
            equivalent: list.reason(mutant).map(str::to_owned),
        };
        Self {
            schema: 1,
            adapter,
            whole,
            totals,
            mutants: mutants.iter().zip(fates).map(row).collect(),
            took,
        }
    }

    /// What does not do, one line each; nothing when the run is fine.
    pub(crate) fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        if self.whole && self.totals.share() < GOAL {
            faults.push(format!(
                "{:.1} % caught, less than {GOAL:.0} %",
                self.totals.share()
            ));
        }
        let unlisted = self.survivors().filter(|row| row.equivalent.is_none()).count();
        if unlisted > 0 {
            faults.push(format!(
                "{unlisted} survivors are not listed: an input, a case or an oracle is missing"
            ));
        }
        let needless = self
            .mutants
            .iter()
            .filter(|row| row.equivalent.is_some() && !row.fate.survived());
        faults.extend(needless.map(|row| {
            format!(
                "{} is listed as equivalent, but {}",
                row.mutant.id,
                row.fate.told()
            )
        }));
        faults
    }

    fn survivors(&self) -> impl Iterator<Item = &Row<'a>> {
        self.mutants.iter().filter(|row| row.fate.survived())
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        for row in self.survivors() {
            text.push_str(&survivor(row));
        }
        if self.mutants.len() > 1 {
            text.push_str(&self.table("file", |mutant| mutant.file.clone()));
            text.push_str(&self.table("operator", |mutant| mutant.operator.to_owned()));
        } else {
            self.mutants
                .iter()
                .for_each(|row| text.push_str(&format!("{}: {}\n\n", row.mutant.id, row.fate.told())));
        }
        text.push_str(&self.summary());
        for fault in self.faults() {
            text.push_str(&format!("FAIL: {fault}\n"));
        }
        text
    }

    fn table(&self, title: &str, key: impl Fn(&Mutant) -> String) -> String {
        let mut rows: BTreeMap<String, Totals> = BTreeMap::new();
        self.mutants
            .iter()
            .for_each(|row| rows.entry(key(row.mutant)).or_default().add(&row.fate));
        let width = rows
            .keys()
            .map(String::len)
            .chain([title.len()])
            .max()
            .unwrap_or_default();
        let mut text = format!("{title:width$}  counted  caught  missed    share  not counted\n");
        for (name, totals) in rows {
            let (counted, caught) = (totals.counted(), totals.all_caught());
            let _ = writeln!(
                text,
                "{name:width$}  {counted:7}  {caught:6}  {:6}  {:5.1} %  {:11}",
                counted - caught,
                totals.share(),
                totals.invalid
            );
        }
        text.push('\n');
        text
    }

    fn summary(&self) -> String {
        let it = self.totals;
        let seconds = self.took.as_secs_f64();
        format!(
            "{} of {} mutants caught ({:.1} %; {} by never ending, {} by ending the process), {} survived ({} reached by no case), \
             on {} in {seconds:.0} s.\n{} more do not assemble or validate and do not count.\n",
            it.all_caught(),
            it.counted(),
            it.share(),
            it.timed_out,
            it.crashed,
            it.survived + it.unreached,
            it.unreached,
            self.adapter,
            it.invalid,
        )
    }
}

fn survivor(row: &Row<'_>) -> String {
    let mutant = row.mutant;
    let listed = match &row.equivalent {
        Some(reason) => format!(
            "listed: {}",
            reason.split_whitespace().collect::<Vec<_>>().join(" ")
        ),
        None => "NOT LISTED".to_owned(),
    };
    format!(
        "{}:{} in {}, {}: {}\n  - {}\n  + {}\n  {listed}\n  again: ./x mutants '{}'\n\n",
        mutant.file,
        mutant.line,
        mutant.item,
        mutant.operator,
        row.fate.told(),
        mutant.was,
        mutant.is,
        mutant.id
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::time::Duration;

    use super::Report;
    use crate::equivalent::List;
    use crate::fate::Fate;
    use crate::generate::of_file;
    use crate::mutant::Mutant;

    const LISTED: &str = "[[mutant]]\nfile = 'x.wesl'\nitem = 'f'\noperator = 'swap_arithmetic'\n\
                          was = 'return a + 1.0;'\nis = 'return a - 1.0;'\nreason = 'for the test'";

    fn mutants() -> Vec<Mutant> {
        of_file("x.wesl", "fn f(a: f32) -> f32 {\nreturn a + 1.0;\n}").unwrap()
    }

    fn caught() -> Fate {
        Fate::Caught {
            case: "f/edge".to_owned(),
            reason: "outside".to_owned(),
        }
    }

    fn report<'a>(mutants: &'a [Mutant], fates: Vec<Fate>, list: &str) -> Report<'a> {
        let list = List::parse(Path::new("list"), list).unwrap();
        Report::new(
            "lavapipe".to_owned(),
            true,
            mutants,
            fates,
            &list,
            Duration::from_secs(1),
        )
    }

    #[test]
    fn all_caught_is_fine() {
        let mutants = mutants();
        let report = report(&mutants, vec![caught(); mutants.len()], "");
        assert_eq!(report.faults(), Vec::<String>::new());
        assert!(report.text().contains("(100.0 %"));
    }

    #[test]
    fn a_survivor_must_be_listed_and_few() {
        let mutants = mutants();
        let mut fates = vec![caught(); mutants.len()];
        let swap = mutants
            .iter()
            .position(|mutant| mutant.operator == "swap_arithmetic")
            .unwrap();
        fates[swap] = Fate::Survived { cases: 2 };
        let unlisted = report(&mutants, fates.clone(), "");
        assert_eq!(unlisted.faults().len(), 2, "{:?}", unlisted.faults());
        let text = unlisted.text();
        assert!(
            text.contains("  - return a + 1.0;\n  + return a - 1.0;\n  NOT LISTED\n"),
            "{text}"
        );
        assert!(
            text.contains("again: ./x mutants 'x.wesl:f:swap_arithmetic:1'"),
            "{text}"
        );
        // Listed, but still too many of these few.
        let faults = report(&mutants, fates, LISTED).faults();
        assert!(
            faults.len() == 1 && faults[0].contains("less than 95 %"),
            "{faults:?}"
        );
    }

    #[test]
    fn an_entry_that_is_caught_fails_the_run() {
        let mutants = mutants();
        let faults = report(&mutants, vec![caught(); mutants.len()], LISTED).faults();
        assert_eq!(faults.len(), 1);
        assert!(
            faults[0].contains("is listed as equivalent, but caught by f/edge"),
            "{faults:?}"
        );
    }

    #[test]
    fn what_does_not_validate_does_not_count() {
        let mutants = mutants();
        let mut fates = vec![
            Fate::Invalid {
                reason: "type".to_owned()
            };
            mutants.len()
        ];
        fates[0] = Fate::TimedOut {
            case: "f/edge".to_owned(),
        };
        let report = report(&mutants, fates, "");
        assert!(report.faults().is_empty());
        assert!(
            report
                .text()
                .contains("1 of 1 mutants caught (100.0 %; 1 by never ending"),
            "{}",
            report.text()
        );
    }
}
