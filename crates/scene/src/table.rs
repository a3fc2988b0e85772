//! The plan as text for a terminal: per material a block, per effect a line, then who shares what.

use std::fmt;

use crate::choose::Candidate;
use crate::plan::{Effect, Fact, MaterialPlan, Plan, State};
use crate::technique::Settings;

impl fmt::Display for Plan {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            out,
            "{}   wanted: {} (99th percentile)",
            self.scene.display(),
            self.wanted()
        )?;
        for material in &self.materials {
            write!(out, "\n{material}")?;
        }
        writeln!(
            out,
            "\npermutations: {} for {} materials",
            self.permutations.len(),
            self.materials.len()
        )?;
        for permutation in &self.permutations {
            writeln!(
                out,
                "  {}  <- {}",
                permutation.name,
                permutation.materials.join(", ")
            )?;
        }
        Ok(())
    }
}

impl fmt::Display for MaterialPlan {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(out, "material {}", self.name)?;
        writeln!(out, "  technique    {} ({})", self.drawn_by(), self.technique_by)?;
        writeln!(out, "  shading      {} ({})", self.shading, self.shading_by)?;
        writeln!(out, "  permutation  {}", self.permutation)?;
        writeln!(out, "  predicted    {}", predicted(self))?;
        for object in &self.objects {
            writeln!(out, "  object       {}", seen(object))?;
        }
        for note in &self.notes {
            writeln!(out, "  note         {note}")?;
        }
        if !self.drawn {
            writeln!(out, "  note         nothing of it is drawn")?;
        }
        self.effects
            .iter()
            .try_for_each(|effect| writeln!(out, "  {effect}"))?;
        for other in self.choice.iter().flat_map(|choice| &choice.others) {
            writeln!(out, "  instead      {other}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (px, texels) = (Short(self.error.px_p99), Short(self.error.texels_p99));
        let how = with_settings(self.technique, &self.settings);
        write!(out, "{how}: {px} px, {texels} texels, {} ms", Short(self.time_ms))
    }
}

impl MaterialPlan {
    /// The technique with its settings, as `relief layers=16 refinements=5`.
    #[must_use]
    pub fn drawn_by(&self) -> String {
        with_settings(self.technique, &self.settings)
    }
}

fn with_settings(technique: &str, settings: &Settings) -> String {
    let settings = settings.iter().map(|(name, value)| format!(" {name}={value}"));
    std::iter::once(technique.to_owned()).chain(settings).collect()
}

impl fmt::Display for Effect {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let state = match self.state {
            State::Kept => "kept   ",
            State::Dropped => "dropped",
        };
        write!(out, "{state}  {:<18}  {}", self.id.as_str(), self.reason)?;
        let facts: Vec<String> = self
            .evidence
            .iter()
            .map(|(name, fact)| format!("{name} = {fact}"))
            .collect();
        if facts.is_empty() {
            Ok(())
        } else {
            write!(out, "  [{}]", facts.join(", "))
        }
    }
}

impl fmt::Display for Fact {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(out, "{count}"),
            Self::Number(number) => Short(*number).fmt(out),
            Self::Numbers(numbers) => write!(out, "({})", joined(numbers.iter().map(|n| Short(*n)))),
            Self::Text(text) => out.write_str(text),
            Self::Names(names) if names.is_empty() => out.write_str("none"),
            Self::Names(names) => write!(out, "({})", joined(names.iter())),
        }
    }
}

fn joined(items: impl Iterator<Item = impl fmt::Display>) -> String {
    items.map(|item| item.to_string()).collect::<Vec<_>>().join(", ")
}

fn seen(object: &crate::plan::ObjectView) -> String {
    match &object.footprint {
        None => format!("{}: out of view", object.name),
        Some(seen) => format!(
            "{}: {:.0} px, nearest {}, a tile spans up to {} px",
            object.name,
            seen.area_px,
            Short(seen.nearest_depth),
            Short(seen.tile_px)
        ),
    }
}

fn predicted(material: &MaterialPlan) -> String {
    let error = match (
        material.predicted.error_px_p99,
        material.predicted.error_texels_p99,
    ) {
        (Some(px), Some(texels)) => format!("error p99 {} px, {} texels", Short(px), Short(texels)),
        _ => "no error to predict: nothing of it is seen".to_owned(),
    };
    let error = match material.predicted.time_ms {
        Some(time) => format!("{error}; {} ms of relief", Short(time)),
        None => error,
    };
    match (material.predicted.ops, material.predicted.fetches) {
        (Some(ops), Some(fetches)) => format!("{error}; {ops} operations and {fetches} fetches a pixel"),
        _ => error,
    }
}

/// A number to four significant digits, without an exponent between a thousandth and a million.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let magnitude = self.0.abs();
        if self.0 == 0.0 || !self.0.is_finite() || (self.0.fract() == 0.0 && magnitude < 1e6) {
            return write!(out, "{}", self.0);
        }
        if !(1e-3..1e6).contains(&magnitude) {
            return write!(out, "{:.3e}", self.0);
        }
        let decimals = (3 - magnitude.log10().floor() as i32).clamp(0, 6) as usize;
        let text = format!("{:.decimals$}", self.0);
        out.write_str(if decimals > 0 {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Short;

    #[test]
    fn four_digits() {
        let shown = |x| Short(x).to_string();
        assert_eq!(
            [
                shown(0.0),
                shown(1.0),
                shown(0.019_999_7),
                shown(123.456),
                shown(98765.4),
                shown(2.5e-7),
                shown(f64::INFINITY)
            ],
            ["0", "1", "0.02", "123.5", "98765", "2.500e-7", "inf"]
        );
    }
}
