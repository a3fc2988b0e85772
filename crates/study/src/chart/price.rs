//! Other prices of accuracy: one row a variant, its errors on the left, and beside them what it costs.

use std::collections::BTreeMap;

use super::plot::{Area, Axis, Drawn, Margins, Plot, short};
use super::scale::LogScale;
use super::style::Look;
use super::{Kind, Plan, file_part};
use crate::record::{Price, Study};

/// Height of a row, and of what is above and below all rows.
const ROW: u32 = 30;
const AROUND: u32 = 110;
const WIDTH: u32 = 900;

/// One chart for each name in the order in which the study has them.
pub(super) fn plans(study: &Study) -> Vec<Plan<'_>> {
    let mut charts: BTreeMap<&str, Vec<&Price>> = BTreeMap::new();
    let mut order: Vec<&str> = Vec::new();
    for price in &study.prices {
        if !charts.contains_key(price.chart.as_str()) {
            order.push(&price.chart);
        }
        charts.entry(&price.chart).or_default().push(price);
    }
    order
        .into_iter()
        .map(|chart| plan(chart, charts.remove(chart).unwrap_or_default()))
        .collect()
}

fn plan<'a>(chart: &'a str, prices: Vec<&'a Price>) -> Plan<'a> {
    Plan {
        kind: Kind::Price,
        name: format!("price-{}", file_part(chart)),
        title: format!("{chart}: error and cost of each variant"),
        alt: alt(chart, &prices),
        subject: chart.to_owned(),
        size: (WIDTH, AROUND + ROW * prices.len() as u32),
        body: Box::new(move |area| draw(area, &prices)),
    }
}

fn alt(chart: &str, prices: &[&Price]) -> String {
    let said: Vec<String> = prices
        .iter()
        .map(|price| {
            let time = price
                .time_ms
                .as_ref()
                .map_or(String::new(), |time| format!(", {} ms", short(time.median)));
            format!(
                "{}: {} {} (p99){time}, {} operations",
                price.variant,
                short(price.p99),
                price.unit,
                short(price.ops)
            )
        })
        .collect();
    format!("Error and cost of the variants of {chart}. {}.", said.join("; "))
}

/// One kind of cost: its title, and the amount with its spread.
type Column = (&'static str, fn(&Price) -> Option<[f64; 3]>);

const COSTS: [Column; 4] = [
    ("time, ms", |price| {
        price
            .time_ms
            .as_ref()
            .map(|time| [time.min, time.median, time.max])
    }),
    ("operations", |price| Some([price.ops; 3])),
    ("reads", |price| Some([price.fetches; 3])),
    ("bytes", |price| Some([price.bytes; 3])),
];

fn draw(area: &Area<'_>, prices: &[&Price]) -> Drawn {
    let (_, below) = area.split_vertically(40);
    let (left, right) = below.split_horizontally(520);
    errors(&left, prices)?;
    // A cost that no variant has is left out.
    let costs: Vec<Column> = COSTS
        .into_iter()
        .filter(|(_, cost)| {
            prices
                .iter()
                .any(|price| cost(price).is_some_and(|[.., most]| most > 0.0))
        })
        .collect();
    for (part, column) in right.split_evenly((1, costs.len().max(1))).iter().zip(costs) {
        cost(part, prices, column)?;
    }
    Ok(())
}

/// Median, p99 and greatest error, joined.
fn errors(area: &Area<'_>, prices: &[&Price]) -> Drawn {
    let x = Axis::Log(LogScale::over(
        prices.iter().flat_map(|price| [price.p50, price.p99, price.max]),
    ));
    let y = Axis::Rows(prices.iter().map(|price| price.variant.clone()).collect());
    let units: Vec<&str> = prices.iter().map(|price| price.unit.as_str()).collect();
    let unit = units.first().copied().unwrap_or_default();
    let title = format!("error, {unit}: bar from median to greatest, mark at p99");
    let margins = Margins {
        left: 190,
        right: 8,
        top: 4,
        bottom: 58,
    };
    let plot = Plot::on(area, (x, &title), (y, ""), margins)?;
    let look = Look::of(0);
    for (row, price) in prices.iter().enumerate() {
        plot.bar((price.p50, price.max), row as f64, look.ink)?;
        plot.marker(price.p99, row as f64, look)?;
    }
    Ok(())
}

fn cost(area: &Area<'_>, prices: &[&Price], (title, amount): Column) -> Drawn {
    let x = Axis::linear(
        prices
            .iter()
            .filter_map(|price| amount(price))
            .map(|[.., most]| most),
    );
    let y = Axis::Rows(vec![String::new(); prices.len()]);
    let margins = Margins {
        left: 8,
        right: 14,
        top: 4,
        bottom: 58,
    };
    let plot = Plot::on(area, (x, title), (y, ""), margins)?;
    let look = Look::of(1);
    for (row, price) in prices.iter().enumerate() {
        let Some([least, middle, most]) = amount(price) else {
            let (_, pixel) = plot.pixel(0.0, row as f64);
            let column = plot.pixel(0.0, row as f64).0 + 6;
            plot.words("not timed", (column, pixel), 13.0)?;
            continue;
        };
        if least < most {
            plot.bar((least, most), row as f64, look.ink)?;
        }
        plot.marker(middle, row as f64, look)?;
    }
    Ok(())
}
