//! The pictures of the examples: panels of lines, areas and points in one style, as SVG.
//!
//! A picture goes to `target/figures`, or to `docs/images` if the example is run with `-- --docs`.
#![allow(dead_code, reason = "each example draws with its own part")]

use plotters::coord::Shift;
use plotters::prelude::*;
pub use plotters::prelude::{RGBColor, SeriesLabelPosition};
use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;

/// Magnification: Plotters counts in whole pixels, so a picture is drawn ten times as large and
/// shown at its size.
const FINE: i32 = 10;
/// Margins of a panel around its plot, in pixels: left, right, above, below.
const ROOM: [i32; 4] = [60, 16, 34, 42];
/// Height of letters in pixels. A picture up to 980 pixels wide is legible on a page of 800.
const FONT: i32 = 14;

pub const BLUE: RGBColor = RGBColor(31, 95, 168);
pub const RED: RGBColor = RGBColor(181, 64, 26);
pub const GRAY: RGBColor = RGBColor(110, 110, 110);
pub const BLACK: RGBColor = RGBColor(20, 20, 20);
/// End of a label: Plotters takes letters for narrower than they are.
const ROOM_OF_LABEL: &str = "  ";
/// Border of a legend.
const BORDER: RGBColor = RGBColor(190, 190, 190);

pub type Points = Vec<(f64, f64)>;

enum Shape {
    Line { points: Points, color: RGBColor, dashed: bool, label: String },
    Dots { points: Points, color: RGBColor, label: String },
    Area { points: Points, color: RGBColor },
    Note { x: f64, y: f64, text: String, color: RGBColor },
}

/// Diagram with its axes.
pub struct Panel {
    title: String,
    /// Quantity and unit of x and of y.
    labels: [String; 2],
    ranges: [[f64; 2]; 2],
    /// Width and height of the plot, in pixels.
    size: [i32; 2],
    /// True for an axis that shows powers of ten.
    powers: [bool; 2],
    legend: SeriesLabelPosition,
    shapes: Vec<Shape>,
}

impl Panel {
    /// Makes a plot of 480 by 240 pixels. Each axis is given by its quantity with unit, and its
    /// range.
    pub fn new(title: &str, x: (&str, [f64; 2]), y: (&str, [f64; 2])) -> Self {
        Self {
            title: title.to_owned(),
            labels: [x.0, y.0].map(str::to_owned),
            ranges: [x.1, y.1],
            size: [480, 240],
            powers: [false; 2],
            legend: SeriesLabelPosition::UpperRight,
            shapes: Vec::new(),
        }
    }

    pub fn size(mut self, width: i32, height: i32) -> Self {
        self.size = [width, height];
        self
    }

    /// Sets the width, and the height that gives equal scales on both axes.
    pub fn with_equal_scales(self, width: i32) -> Self {
        let [x, y] = self.ranges.map(|[from, to]| to - from);
        self.size(width, (f64::from(width) * y / x).round() as i32)
    }

    /// Makes axes show powers of ten: x or y are logarithms.
    pub fn powers(mut self, x: bool, y: bool) -> Self {
        self.powers = [x, y];
        self
    }

    pub fn legend(mut self, position: SeriesLabelPosition) -> Self {
        self.legend = position;
        self
    }

    /// Adds a line; without a label it is not in the legend.
    pub fn line(self, points: Points, color: RGBColor, label: &str) -> Self {
        self.with(Shape::Line { points, color, dashed: false, label: label.to_owned() })
    }

    pub fn dashed(self, points: Points, color: RGBColor, label: &str) -> Self {
        self.with(Shape::Line { points, color, dashed: true, label: label.to_owned() })
    }

    pub fn dots(self, points: Points, color: RGBColor, label: &str) -> Self {
        self.with(Shape::Dots { points, color, label: label.to_owned() })
    }

    /// Fills the area inside a closed line, which must be within the axes.
    pub fn area(self, points: Points, color: RGBColor) -> Self {
        self.with(Shape::Area { points, color })
    }

    /// Adds a body: its outline, and the area between the outline and y.
    pub fn body(mut self, outline: Points, y: f64, color: RGBColor, label: &str) -> Self {
        for mut part in self.visible(&outline) {
            part.extend([(part[part.len() - 1].0, y), (part[0].0, y)]);
            self = self.area(part, tint(color, 0.18));
        }
        self.line(outline, color, label)
    }

    /// Cuts a line where it crosses the axes, and returns the parts between them.
    fn visible(&self, line: &[(f64, f64)]) -> Vec<Points> {
        let mut parts: Vec<Points> = Vec::new();
        for two in line.windows(2) {
            let [(x, y), (x_to, y_to)] = [two[0], two[1]];
            let (mut enter, mut leave) = (0.0f64, 1.0f64);
            for ([low, high], from, to) in [(self.ranges[0], x, x_to), (self.ranges[1], y, y_to)] {
                let rounding = 1e-9 * (high - low);
                let share = [low - rounding, high + rounding].map(|end| (end - from) / (to - from));
                enter = enter.max(share[0].min(share[1]));
                leave = leave.min(share[0].max(share[1]));
            }
            if enter >= leave {
                continue;
            }
            let at = |share: f64| (x + share * (x_to - x), y + share * (y_to - y));
            match parts.last_mut() {
                Some(part) if part.last() == Some(&at(enter)) => {}
                _ => parts.push(vec![at(enter)]),
            }
            let last = if leave < 1.0 { at(leave) } else { two[1] };
            parts.last_mut().expect("one is there").push(last);
        }
        parts
    }

    /// Adds a vertical line with its name on top, as for a limit of the contact.
    pub fn limit(self, x: f64, name: &str) -> Self {
        let [from, to] = self.ranges[1];
        let pixel = (to - from) / f64::from(self.size[1]);
        let line = vec![(x, from), (x, to - pixel * f64::from(FONT + 5))];
        self.dashed(line, GRAY, "").note(x, to - 3.0 * pixel, name, BLACK)
    }

    /// Adds a text, centred on x, with its top at y.
    pub fn note(self, x: f64, y: f64, text: &str, color: RGBColor) -> Self {
        self.with(Shape::Note { x, y, text: text.to_owned(), color })
    }

    /// Fills the levels of a function between the lowest and the highest, darker for higher ones.
    pub fn levels(mut self, function: &Grid, levels: &[f64], color: RGBColor) -> Self {
        for (i, &level) in levels.iter().enumerate() {
            for points in function.surrounding(level) {
                self = self.area(points, shade(color, i, levels));
            }
        }
        self
    }

    /// Makes a bar that shows the colours of equidistant levels.
    pub fn key(label: &str, width: i32, levels: &[f64], color: RGBColor) -> Self {
        let high = levels[levels.len() - 1] + levels[0];
        let bar = Self::new("", (label, [0.0, high]), ("", [0.0, 1.0])).size(width, 12);
        levels.iter().enumerate().fold(bar, |bar, (i, &low)| {
            let corners = vec![(low, 0.0), (high, 0.0), (high, 1.0), (low, 1.0)];
            bar.area(corners, shade(color, i, levels))
        })
    }

    fn with(mut self, shape: Shape) -> Self {
        self.shapes.push(shape);
        self
    }

    /// Returns width and height, margins included.
    fn whole(&self) -> [i32; 2] {
        let below = if self.labels[0].is_empty() { 10 } else { ROOM[3] };
        [self.size[0] + ROOM[0] + ROOM[1], self.size[1] + self.above() + below]
    }

    fn above(&self) -> i32 {
        if self.title.is_empty() { 10 } else { ROOM[2] }
    }

    fn draw(&self, area: &DrawingArea<SVGBackend, Shift>) -> Result<(), Box<dyn Error>> {
        // Plotters writes a size divided by 1.24.
        let pixels = |size: i32| 1.24 * f64::from(FINE * size);
        let font = |size: i32| ("sans-serif", pixels(size)).into_font().color(&BLACK);
        let [[left, right], [bottom, top]] = self.ranges;
        let middle = FINE * (ROOM[0] + self.size[0] / 2);
        let title = font(FONT + 1).pos(anchor());
        area.draw(&Text::new(self.title.clone(), (middle, 12 * FINE), title))?;
        let above = self.above();
        let below = self.whole()[1] - above - self.size[1];
        let mut chart = ChartBuilder::on(area)
            .margin_top(FINE * above)
            .margin_right(FINE * ROOM[1])
            .margin_left(FINE * 4)
            .margin_bottom(FINE * 2)
            .x_label_area_size(FINE * (below - 2))
            .y_label_area_size(FINE * (ROOM[0] - 4))
            .build_cartesian_2d(left..right, bottom..top)?;
        let number = |axis: usize| {
            let powers = self.powers[axis];
            move |x: &f64| if powers { power(*x) } else { decimal(*x) }
        };
        let ticks = |axis: usize, room: i32| {
            let [from, to] = self.ranges[axis];
            let whole = if self.powers[axis] { (to - from) as usize + 1 } else { usize::MAX };
            let most = whole.min((self.size[axis] / room).max(3) as usize);
            if self.labels[axis].is_empty() { 0 } else { most }
        };
        let (x_number, y_number) = (number(0), number(1));
        let mut mesh = chart.configure_mesh();
        mesh.x_desc(self.labels[0].clone())
            .y_desc(self.labels[1].clone())
            .x_labels(ticks(0, if self.powers[0] { 40 } else { 60 }))
            .y_labels(ticks(1, 28))
            .x_label_formatter(&x_number)
            .y_label_formatter(&y_number)
            .label_style(font(FONT - 1))
            .axis_desc_style(font(FONT))
            .axis_style(BLACK.stroke_width(FINE as u32))
            .bold_line_style(RGBColor(225, 225, 225).stroke_width(FINE as u32 / 2))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(FINE * 4);
        mesh.draw()?;
        let inside = |&(x, y): &(f64, f64)| {
            let within = |x: f64, [from, to]: [f64; 2]| {
                let rounding = 1e-9 * (to - from);
                from - rounding <= x && x <= to + rounding
            };
            within(x, self.ranges[0]) && within(y, self.ranges[1])
        };
        let mut legend = false;
        for shape in &self.shapes {
            match shape {
                Shape::Line { points, color, dashed, label } => {
                    let style = color.stroke_width(if *dashed { 12 } else { 18 });
                    for part in self.visible(points) {
                        if *dashed {
                            let line = DashedLineSeries::new(part, 70, 50, style);
                            chart.draw_series(line)?;
                        } else {
                            chart.draw_series([PathElement::new(part, style)])?;
                        }
                    }
                    if !label.is_empty() {
                        legend = true;
                        let key = move |(x, y)| {
                            let ends =
                                [(x, y), (x + 9 * FINE, y), (x + 14 * FINE, y), (x + 22 * FINE, y)];
                            let ends =
                                if *dashed { ends } else { [ends[0], ends[1], ends[1], ends[3]] };
                            EmptyElement::at((0, 0))
                                + PathElement::new(ends[..2].to_vec(), style)
                                + PathElement::new(ends[2..].to_vec(), style)
                        };
                        chart
                            .draw_series([PathElement::new(vec![], style)])?
                            .label(format!("{label}{ROOM_OF_LABEL}"))
                            .legend(key);
                    }
                }
                Shape::Dots { points, color, label } => {
                    let dot = |at| Circle::new(at, 24, color.filled());
                    chart.draw_series(points.iter().copied().filter(inside).map(dot))?;
                    if !label.is_empty() {
                        legend = true;
                        let key = move |(x, y)| Circle::new((x + 11 * FINE, y), 24, color.filled());
                        chart
                            .draw_series([PathElement::new(vec![], color)])?
                            .label(format!("{label}{ROOM_OF_LABEL}"))
                            .legend(key);
                    }
                }
                Shape::Area { points, color } => {
                    chart.draw_series([Polygon::new(points.clone(), color.filled())])?;
                }
                Shape::Note { x, y, text, color } => {
                    let style = font(FONT).color(color).pos(anchor());
                    chart.draw_series([Text::new(text.clone(), (*x, *y), style)])?;
                }
            }
        }
        if legend {
            let mut labels = chart.configure_series_labels();
            labels
                .position(self.legend.clone())
                .margin(FINE * 9)
                .legend_area_size(FINE * 28)
                .background_style(WHITE)
                .border_style(BORDER)
                .label_font(font(FONT - 1));
            labels.draw()?;
        }
        // The frame, on top of lines that end at it.
        let [width, height] = self.size.map(|size| FINE * size);
        let corner = (FINE * ROOM[0], FINE * above);
        let (right, bottom) = (corner.0 + width, corner.1 + height);
        let frame = vec![corner, (right, corner.1), (right, bottom), (corner.0, bottom), corner];
        area.draw(&PathElement::new(frame, BLACK.stroke_width(FINE as u32)))?;
        Ok(())
    }
}

/// Draws panels in columns side by side, and returns a line that names the file.
pub fn save(name: &str, columns: Vec<Vec<Panel>>) -> Result<String, Box<dyn Error>> {
    let docs = std::env::args().any(|argument| argument == "--docs");
    let folder = if docs { "docs/images" } else { "target/figures" };
    fs::create_dir_all(folder)?;
    let path = format!("{folder}/{name}.svg");
    write(Path::new(&path), columns)?;
    Ok(path)
}

/// Draws panels into a file.
pub fn write(path: &Path, columns: Vec<Vec<Panel>>) -> Result<(), Box<dyn Error>> {
    let width = |column: &[Panel]| column.iter().map(|panel| panel.whole()[0]).max().unwrap_or(0);
    let height = |column: &[Panel]| column.iter().map(|panel| panel.whole()[1]).sum::<i32>();
    let size = [
        columns.iter().map(|column| width(column)).sum::<i32>(),
        columns.iter().map(|column| height(column)).max().unwrap_or(0),
    ];
    let mut svg = String::new();
    {
        let [width_px, height_px] = size.map(|size| (FINE * size) as u32);
        let root = SVGBackend::with_string(&mut svg, (width_px, height_px)).into_drawing_area();
        root.fill(&WHITE)?;
        let mut x = 0;
        for column in &columns {
            let mut y = 0;
            for panel in column {
                let [wide, high] = panel.whole().map(|size| (FINE * size) as u32);
                panel.draw(&root.clone().shrink((FINE * x, FINE * y), (wide, high)))?;
                y += panel.whole()[1];
            }
            x += width(column);
        }
        root.present()?;
    }
    let [large, shown] =
        [FINE, 1].map(|by| format!("<svg width=\"{}\" height=\"{}\"", by * size[0], by * size[1]));
    // Plotters writes no width of a border.
    let [thin, border] =
        ["/>", " stroke-width=\"8\"/>"].map(|end| format!("stroke=\"#BEBEBE\"{end}"));
    fs::write(path, svg.replacen(&large, &shown, 1).replace(&thin, &border))?;
    Ok(())
}

/// Returns the colour above a level.
fn shade(color: RGBColor, i: usize, levels: &[f64]) -> RGBColor {
    tint(color, 0.08 + 0.8 * i as f64 / levels.len() as f64)
}

/// Mixes a colour with white; a share of 1 leaves it unchanged.
pub fn tint(color: RGBColor, share: f64) -> RGBColor {
    mix(WHITE, color, share)
}

/// Mixes two colours.
pub fn mix(from: RGBColor, to: RGBColor, share: f64) -> RGBColor {
    let part = |from: u8, to: u8| {
        (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as u8
    };
    RGBColor(part(from.0, to.0), part(from.1, to.1), part(from.2, to.2))
}

fn anchor() -> plotters::style::text_anchor::Pos {
    use plotters::style::text_anchor::{HPos, Pos, VPos};
    Pos::new(HPos::Center, VPos::Top)
}

/// Formats a number without the noise of its last digits.
fn decimal(x: f64) -> String {
    let text = format!("{x:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

fn power(exponent: f64) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
    };
    if exponent.fract() != 0.0 {
        return String::new();
    }
    format!("10{}", format!("{exponent:.0}").chars().map(digit).collect::<String>())
}

/// Function on a grid.
pub struct Grid {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Values by row, one row for each y.
    values: Vec<Vec<f64>>,
}

/// Edge of the grid: from the node in a column and a row to the next one along x (0) or y (1).
type GridEdge = (usize, usize, usize);

impl Grid {
    /// Evaluates a function at equal distances, with `counts` intervals along x and y.
    ///
    /// # Errors
    /// The errors of the function.
    pub fn new<E>(
        x: [f64; 2],
        y: [f64; 2],
        counts: [u32; 2],
        mut function: impl FnMut(f64, f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let places = |[from, to]: [f64; 2], count: u32| -> Vec<f64> {
            (0..=count).map(|i| from + (to - from) * f64::from(i) / f64::from(count)).collect()
        };
        let (x, y) = (places(x, counts[0]), places(y, counts[1]));
        let mut row = |&y: &f64| x.iter().map(|&x| function(x, y)).collect::<Result<_, _>>();
        let values = y.iter().map(&mut row).collect::<Result<_, _>>()?;
        Ok(Self { x, y, values })
    }

    /// Returns closed lines that have all values above a level on their left (marching squares).
    /// Points around the grid count as low.
    fn surrounding(&self, level: f64) -> Vec<Points> {
        let (columns, rows) = (self.x.len(), self.y.len());
        let outside = |i: usize, j: usize| i == 0 || j == 0 || i > columns || j > rows;
        let value =
            |i: usize, j: usize| if outside(i, j) { level } else { self.values[j - 1][i - 1] };
        let place =
            |i: usize, j: usize| (self.x[i.clamp(1, columns) - 1], self.y[j.clamp(1, rows) - 1]);
        let mut next = BTreeMap::<GridEdge, GridEdge>::new();
        for (i, j) in (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j))) {
            let high =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| value(i, j) > level);
            let edges = [(i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)];
            // Going anticlockwise around the cell, a line enters where high turns low. It leaves at
            // the nearest edge before that where low turns high.
            for edge in (0..4).filter(|&edge| high[edge] && !high[(edge + 1) % 4]) {
                let back = (1..4).map(|step| (edge + 4 - step) % 4);
                let leaves = back.into_iter().find(|&edge| !high[edge] && high[(edge + 1) % 4]);
                next.extend(leaves.map(|leaves| (edges[edge], edges[leaves])));
            }
        }
        let crossing = |(i, j, along): GridEdge| {
            let other = if along == 0 { (i + 1, j) } else { (i, j + 1) };
            let (from, to) = (value(i, j), value(other.0, other.1));
            let share = (level - from) / (to - from);
            let ((x, y), (x_to, y_to)) = (place(i, j), place(other.0, other.1));
            (x + share * (x_to - x), y + share * (y_to - y))
        };
        let mut lines = Vec::new();
        while let Some((mut edge, mut to)) = next.pop_first() {
            let mut line = vec![crossing(edge)];
            loop {
                edge = to;
                line.push(crossing(edge));
                match next.remove(&edge) {
                    Some(following) => to = following,
                    None => break,
                }
            }
            lines.push(line);
        }
        lines
    }
}
