import type katexModule from "katex";

declare global {
  /** What comes from outside is not known until somebody has looked. */
  interface JSON {
    parse(text: string): unknown;
  }
  interface Body {
    json(): Promise<unknown>;
  }

  /** Set by the classic script vendor/katex/dist/katex.min.js (half the bytes of its ES module). */
  var katex: typeof katexModule;

  /** Set by a bundle of Plotly (with heat maps in the labs, the smaller one elsewhere), loaded when the first plot is wanted. */
  var Plotly: {
    react(root: HTMLElement, data: object[], layout: object, config: object): Promise<void>;
    purge(root: HTMLElement): void;
    downloadImage(figure: object, options: object): Promise<string>;
    Fx: { hover(root: Element, place: { xval: number; yval: number }): void };
  };
}
