// How well words stand out from their ground, as WCAG 2 counts it: 4.5 is enough for all of them.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {folder} from './browser.mjs';

function luminance(colour) {
  const hex = colour.length === 4 ? colour.replace(/[0-9a-f]/g, '$&$&') : colour;
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
export function contrast(one, other) {
  const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

/// The colours that the page names, by light and in the dark, from its own style.
export function themes() {
  const style = /<style>(.*?)<\/style>/s.exec(readFileSync(path.join(folder, 'drive.html'), 'utf8'))[1];
  const [light, dark] = [...style.matchAll(/:root \{(.*?)\}/gs)].map((root) => Object.fromEntries([...root[1].matchAll(/--([\w-]+): (#[0-9a-f]+);/g)].map((one) => one.slice(1))));
  return {light, dark: {...light, ...dark}};
}

/// Runs in the page: the words in sight that stand out too little, as they are drawn, with all that is half transparent.
export function faintText() {
  const canvas = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  canvas.canvas.width = canvas.canvas.height = 1;
  const paint = (under, colour, alpha) => {      // of any form that CSS knows
    canvas.globalAlpha = 1, canvas.fillStyle = `rgb(${under})`, canvas.fillRect(0, 0, 1, 1);
    canvas.globalAlpha = alpha, canvas.fillStyle = colour, canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3);
  };
  const luminance = (rgb) => {
    const [r, g, b] = rgb.map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const weak = new Set(), words = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let word = words.nextNode(); word; word = words.nextNode()) {
    const holder = word.parentElement;
    if (!word.data.trim() || !holder.checkVisibility() || holder.closest('script, option, :disabled, .spoken, .skips, [aria-hidden="true"]')) continue;
    const chain = [];
    for (let one = holder; one; one = one.parentElement) chain.unshift(getComputedStyle(one));
    let ground = [255, 255, 255], alpha = 1;
    for (const style of chain) alpha *= Number(style.opacity), ground = paint(ground, style.backgroundColor, alpha);
    const [low, high] = [luminance(paint(ground, chain.at(-1).color, alpha)), luminance(ground)].sort((a, b) => a - b), ratio = (high + 0.05) / (low + 0.05);
    if (ratio < 4.5) weak.add(`${holder.className || holder.tagName} "${word.data.trim().slice(0, 20)}": ${ratio.toFixed(2)}`);
  }
  return [...weak];
}
