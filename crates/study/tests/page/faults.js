(() => {
  const faults = [];
  const all = (selector) => [...document.querySelectorAll(selector)];
  const say = (fault, at) => faults.push(`${fault}: ${at.tagName.toLowerCase()} ${at.outerHTML.slice(0, 80)}`);

  if (!document.documentElement.lang) faults.push("no language");
  for (const image of all("img")) if (!image.alt?.trim()) say("no alt", image);
  for (const table of all("table")) if (!table.caption?.textContent.trim()) say("table without caption", table);
  for (const head of all("th")) if (!head.scope) say("head without scope", head);

  if (all("h1").length !== 1) faults.push("not one h1");
  let level = 0;
  for (const heading of all("h1, h2, h3, h4, h5, h6")) {
    const next = Number(heading.tagName[1]);
    if (next > level + 1) say(`heading skips from ${level} to ${next}`, heading);
    if (!heading.textContent.trim()) say("empty heading", heading);
    level = next;
  }

  const ids = all("[id]").map((at) => at.id);
  for (const id of ids) if (ids.indexOf(id) !== ids.lastIndexOf(id)) faults.push(`id twice: ${id}`);
  for (const link of all('a[href^="#"]')) if (!document.getElementById(link.hash.slice(1))) say("leads nowhere", link);
  for (const at of all("[aria-labelledby]")) {
    for (const id of at.getAttribute("aria-labelledby").split(" ")) if (!document.getElementById(id)) say("label is not there", at);
  }

  // WCAG 1.4.3: 4.5 between words and what is behind them.
  const channels = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = ([r, g, b]) => {
    const linear = [r, g, b].map((byte) => ((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))(byte / 255));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const behind = (at) => {
    for (; at; at = at.parentElement) {
      const colour = channels(getComputedStyle(at).backgroundColor);
      if (colour.length === 3 || colour[3] > 0) return colour;
    }
    return [255, 255, 255];
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const at = walker.currentNode.parentElement;
    if (!walker.currentNode.textContent.trim() || at.closest("svg, script, style")) continue;
    const [a, b] = [channels(getComputedStyle(at).color), behind(at)].map((colour) => luminance(colour) + 0.05);
    if (Math.max(a, b) / Math.min(a, b) < 4.5) say("contrast", at);
  }
  return faults;
})()
